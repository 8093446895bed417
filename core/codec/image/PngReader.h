// PNG files through libpng, as OpenImageIO 2.4 reads them: palettes and small depths become 8 bits,
// transparent colours become alpha, 16 bits stay. No colour is converted.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace patina::codec {

class PictureReader;

// `file` must outlive the reader. `inspect`: attributes matter, too. Throws HandOn.
std::unique_ptr<PictureReader> readPng(std::span<const std::byte> file, bool inspect);

} // namespace patina::codec

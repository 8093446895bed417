// JPEG files through libjpeg-turbo, as OpenImageIO 2.4 reads them: grey and colour of 8 bits.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace patina::codec {

class PictureReader;

// `file` must outlive the reader. `inspect`: attributes matter, too. Throws HandOn.
std::unique_ptr<PictureReader> readJpeg(std::span<const std::byte> file, bool inspect);

} // namespace patina::codec

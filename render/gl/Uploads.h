// How much has been handed to OpenGL: what a change of a scene costs, as a number that does not
// depend on the machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patina::gl {

// Bytes that the calling thread has put into buffers and textures so far.
[[nodiscard]] std::uint64_t uploadedBytes();
void countUpload(std::size_t bytes);

} // namespace patina::gl

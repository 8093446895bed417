#include "render/gl/Uploads.h"

namespace patina::gl {
namespace {

thread_local std::uint64_t uploaded = 0;

} // namespace

std::uint64_t uploadedBytes() {
    return uploaded;
}

void countUpload(std::size_t bytes) {
    uploaded += bytes;
}

} // namespace patina::gl

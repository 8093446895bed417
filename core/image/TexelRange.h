// What the texels of an image lie between.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

namespace patina {

// Per channel of linear RGBA, as Image::linear() gives it.
struct TexelRange {
    glm::vec4 low{1.0f}, mean{1.0f}, high{1.0f};
    friend bool operator==(const TexelRange&, const TexelRange&) = default;
};

// Of all texels; those that are not finite do not count. Unfinished when the job is cancelled.
[[nodiscard]] TexelRange texelRange(const Image& image, const JobContext& job);

} // namespace patina

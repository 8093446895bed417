// What draws hemicubes in place of rays: a graphics card, of which core knows nothing. Whoever has
// one puts it into FactorSettings (render/GpuHemicubes).
#pragma once

#include "core/base/Result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace patina::radiosity {

class FaceItems;
struct PointView;

// Hemicubes over the faces of one scene. Callable from any thread.
class DrawnHemicubes {
  public:
    virtual ~DrawnHemicubes() = default;
    // `items`: of each of HemicubeCells::cells() the number of the face that is seen through its
    // middle, PointFactors::kBack or kOutside.
    virtual void draw(const PointView& view, std::span<std::uint32_t> items) const = 0;
};

class HemicubeDrawer {
  public:
    virtual ~HemicubeDrawer() = default;
    // `faces` must outlive the answer. Errors: Usage for a resolution that is too large for it,
    // Internal. From any thread.
    virtual Result<std::unique_ptr<DrawnHemicubes>> load(const FaceItems& faces,
                                                         int resolution) = 0;
    [[nodiscard]] virtual std::string name() const = 0; // of the graphics card
};

} // namespace patina::radiosity

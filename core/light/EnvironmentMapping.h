// How the pixels of an environment picture cover the sphere: directions, positions, solid angles
// and lookups for every layout. The conventions stand in docs/maths/ibl.md, "Layouts".
#pragma once

#include "core/base/Result.h"
#include "core/image/AreaFilter.h"
#include "core/image/Image.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace patina {

enum class EnvironmentLayout; // core/document/Document.h

// LatLong and VerticalStrip exist twice: OpenEXR's `envmap` attribute announces a picture whose
// outer pixels have their centres on the border, with +Z in the middle of the lat-long and faces
// turned differently.
enum class EnvironmentConvention { Common, OpenExr };

class EnvironmentMapping {
  public:
    // SixFaces are mapped as a vertical strip: their files on top of each other. Usage error that
    // names the proportions when they do not fit the layout. `layout` is not Automatic.
    static Result<EnvironmentMapping>
    create(EnvironmentLayout layout, ImageSize size,
           EnvironmentConvention convention = EnvironmentConvention::Common);

    // The picture's size for `size`: the width of a lat-long (its height is half of it), the
    // diameter of an angular map or mirror ball, the side of a face otherwise.
    static ImageSize imageSize(EnvironmentLayout layout, int size);
    // The size of a lat-long that keeps what the picture holds: twice the diameter, four faces.
    [[nodiscard]] ImageSize latLongSize() const;

    [[nodiscard]] ImageSize size() const { return m_size; }
    // Rows of constant latitude, pixels side by side.
    [[nodiscard]] bool isCommonLatLong() const {
        return m_projection == Projection::LatLong && !m_centresOnBorder;
    }
    friend bool operator==(const EnvironmentMapping&, const EnvironmentMapping&) = default;

    // What a point of the picture sees; positions are in pixels, the centre of pixel (i, j) is
    // (i + 0.5, j + 0.5).
    struct Ray {
        glm::vec3 direction; // unit
        float density;       // solid angle per area of one pixel here, sr
    };
    [[nodiscard]] std::optional<Ray> ray(glm::vec2 position) const; // nothing outside the sphere
    // The inverse. Poles, the rim of a disc and the edges of faces have several positions: one of
    // them.
    [[nodiscard]] glm::vec2 position(const glm::vec3& direction) const;

    // Exact solid angle of pixel (x, y), sr; all pixels sum to 4pi.
    [[nodiscard]] double solidAngle(int x, int y) const;

    // Bilinear radiance of a float RGB picture of this mapping, continued across the borders of
    // faces and discs.
    [[nodiscard]] glm::vec3 lookup(const Image& picture, const glm::vec3& direction) const;

  private:
    enum class Projection { LatLong, Angular, Ball, Cube };
    struct Face {
        glm::vec3 centre{0.0f}, right{0.0f},
            down{0.0f};   // direction = centre + (2s - 1) right + (2t - 1) down
        int x = 0, y = 0; // of its first pixel in the picture
        friend bool operator==(const Face&, const Face&) = default;
    };

    EnvironmentMapping() = default;
    [[nodiscard]] glm::vec2 chart(glm::vec2 position) const; // 0…1 across the whole picture
    [[nodiscard]] glm::vec2 pixels(glm::vec2 chart) const;   // the inverse
    [[nodiscard]] int faceTowards(const glm::vec3& direction) const;
    [[nodiscard]] glm::vec2 onFace(int face, const glm::vec3& direction) const; // 0…1
    [[nodiscard]] glm::vec3 texel(const Image& picture, int face, int x, int y) const;
    [[nodiscard]] glm::vec3 lookupCube(const Image& picture, const glm::vec3& direction) const;
    [[nodiscard]] glm::vec3 lookupDisc(const Image& picture, const glm::vec3& direction) const;

    Projection m_projection = Projection::LatLong;
    ImageSize m_size;
    int m_faceSize = 0;
    bool m_centresOnBorder = false; // OpenEXR
    bool m_halfTurn = false;        // lat-long: +Z instead of -Z in the middle
    std::array<Face, 6> m_faces;    // +X, -X, +Y, -Y, +Z, -Z
};

} // namespace patina

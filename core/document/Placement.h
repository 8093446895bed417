// Where a mesh stands in the world: as its file says, until a user moves, rotates or scales it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace patina {

// The matrix is T(position) R(rotation) S(scale) K, from the right: the vectors of the mesh's file
// through K, what of the file's matrix the three cannot say (a mirror, shear; else the identity),
// scaled along the mesh's own axes, rotated, moved. R = Rz Ry Rx: first about the world's X.
// Untouched, the matrix is that of the file to the bit.
//
// What a user sets is kept within these ranges.
inline constexpr float kMaxPosition = 1e6f; // metres from the origin, along each axis
inline constexpr float kMinScale = 1e-6f, kMaxScale = 1e6f;

class Placement {
  public:
    Placement() = default;
    // As a file says: affine, finite. A matrix is a placement that nobody has changed.
    Placement(const glm::mat4& asRead); // NOLINT(google-explicit-constructor)

    [[nodiscard]] const glm::mat4& matrix() const { return m_matrix; }         // mesh to world
    [[nodiscard]] const glm::mat4& asRead() const { return m_asRead; }         // of the file
    [[nodiscard]] const glm::vec3& position() const { return m_now.position; } // metres
    [[nodiscard]] const glm::vec3& rotationDeg() const { return m_now.rotationDeg; } // -180…180
    [[nodiscard]] const glm::vec3& scale() const { return m_now.scale; }             // above 0
    [[nodiscard]] bool isAsRead() const { return m_now == m_start; }
    [[nodiscard]] Placement back() const { return m_asRead; } // as its file says

    // Finite.
    void setPosition(const glm::vec3& position);
    void setRotationDeg(const glm::vec3& rotationDeg);
    void setScale(const glm::vec3& scale);

    // Rotates it by `rotation` (orthonormal, det 1) in the world, the point `pivot` staying.
    void rotateAbout(const glm::vec3& pivot, const glm::mat3& rotation);
    // Multiplies its scale along its own axes, the world's point `pivot` staying. Where the pivot
    // is that of several meshes, the three factors are equal.
    void scaleAbout(const glm::vec3& pivot, const glm::vec3& factors);

    // The three axes that scale() is along, in the world: columns.
    [[nodiscard]] glm::mat3 axes() const;

    friend bool operator==(const Placement& a, const Placement& b) {
        return a.m_now == b.m_now && a.m_asRead == b.m_asRead; // the rest follows from these
    }

  private:
    struct Values {
        glm::vec3 position{0.0f}, rotationDeg{0.0f}, scale{1.0f};
        friend bool operator==(const Values&, const Values&) = default;
    };
    [[nodiscard]] static Values valuesOf(const glm::mat4& matrix);
    void update();

    glm::mat4 m_asRead{1.0f}, m_matrix{1.0f};
    Values m_start, m_now; // of m_asRead; of m_matrix
};

} // namespace patina

// The surfaces of a scene divided into flat elements, each of one radiosity: quads and triangles in
// grids over the scene's own faces, any of them divided in four again as often as it takes.
#pragma once

#include "core/base/Result.h"
#include "core/radiosity/Patches.h"
#include "core/radiosity/PolygonFactor.h"
#include "core/trace/RayScene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

namespace patina::radiosity {

inline constexpr std::uint32_t kNone = ~0u;

// A line over all of a quad on which elements end, beside those of its even grid: at one u, or with
// `row` at one v.
struct FaceCut {
    static constexpr float kSame = 1e-5f; // lines that are nearer are one
    std::uint32_t face = 0;
    bool row = false;
    float at = 0.0f; // 0…1
};

// How finely faces are divided to begin with; what is 0 sets no limit.
struct ElementLimits {
    double maxEdge = 0.0; // metres: no edge is longer
    double maxArea = 0.0; // m²: no element is larger
    std::size_t maxElements = 1'000'000;
    // m², not below maxArea: faces are divided into patches of at most this area and no longer
    // edges than maxEdge, and these in four until no element is larger than maxArea. 0: no patches.
    double patchArea = 0.0;
    std::vector<FaceCut> cuts = {}; // of faces as make() numbers them, whatever the other limits
};

// A face of the scene seen from one side: a triangle, or two that make a flat convex quad.
struct Face {
    std::array<glm::dvec3, 4> corners{}; // scene units, counter-clockwise about the normal
    std::array<glm::dvec2, 4> uvs{};     // texture coordinates there
    std::array<glm::vec3, 4> normals{};  // the scene's there, unit, on the side that is seen
    glm::dvec3 normal{0.0};              // unit
    std::uint32_t cornerCount = 3;
    std::uint32_t mesh = 0;                               // of the scene
    std::array<std::uint32_t, 2> triangles{kNone, kNone}; // of the mesh
    bool back = false;                   // of triangles whose two sides both reflect
    std::uint32_t columns = 1, rows = 1; // a triangle has as many rows as columns
    std::uint32_t firstNode = 0;
    bool cut = false;    // by FaceCuts: its columns and rows are not even
    bool fenced = false; // something that stands on it is between elements of it
};

// A face's position from its own coordinates: bilinear over a quad; of a triangle the weights of
// the second and third corner.
[[nodiscard]] glm::dvec3 positionOn(const Face& face, const glm::dvec2& at);
// Texture coordinates there.
[[nodiscard]] glm::dvec2 uvOn(const Face& face, const glm::dvec2& at);
// The scene's normal there, interpolated; unit.
[[nodiscard]] glm::vec3 normalOn(const Face& face, const glm::dvec2& at);
// The inverse of positionOn(), for points in the face's plane.
[[nodiscard]] glm::dvec2 coordinatesOn(const Face& face, const glm::dvec3& position);

class ElementMesh {
  public:
    // A rectangle in a quad's coordinates, or a triangle of legs `extent` in a triangle's, the
    // other way round where they are negative.
    struct Node {
        glm::vec2 origin{0.0f}, extent{1.0f};
        std::uint32_t face = 0;
        std::uint32_t firstChild = kNone; // of four; kNone: it is an element
        std::uint32_t parent = kNone;
        std::uint32_t element = kNone; // its number, of one that is not divided
    };

    // Errors: InputBroken where `geometry` has no face of any area, Usage for a division finer
    // than limits.maxElements, or patches smaller than elements. `geometry` must outlive the
    // answer.
    static Result<ElementMesh> make(const BakeGeometry& geometry, const ElementLimits& limits);

    [[nodiscard]] const BakeGeometry& geometry() const { return *m_geometry; }
    [[nodiscard]] std::size_t size() const { return m_elements.size(); }
    [[nodiscard]] const Face& face(std::uint32_t element) const {
        return m_faces[m_nodes[m_elements[element]].face];
    }
    [[nodiscard]] const std::vector<Face>& faces() const { return m_faces; }
    [[nodiscard]] const Node& node(std::uint32_t element) const {
        return m_nodes[m_elements[element]];
    }
    [[nodiscard]] double area(std::uint32_t element) const { return m_areas[element]; } // m²
    [[nodiscard]] std::span<const double> areas() const { return m_areas; }
    // Share of its area that is not within something else, as a floor is below a block: points that
    // see nothing but backs are. They receive nothing, and what is said of an element is said
    // of the rest of it; 1 until findBuried() was called.
    [[nodiscard]] float exposed(std::uint32_t element) const {
        return m_exposed.empty() ? 1.0f : m_exposed[element];
    }
    void findBuried(const RayScene& rays, const JobContext& job);
    // Whether a point of an element is. Costs a ray, and none for elements that are exposed wholly.
    [[nodiscard]] bool isBuried(std::uint32_t element, const glm::dvec3& position,
                                const RayScene& rays) const;

    [[nodiscard]] Polygon polygon(const Node& node) const; // scene units
    [[nodiscard]] Polygon polygon(std::uint32_t element) const { return polygon(node(element)); }
    [[nodiscard]] glm::dvec3 centre(const Node& node) const;
    [[nodiscard]] glm::dvec3 centre(std::uint32_t element) const { return centre(node(element)); }
    // In the face's coordinates; u is even in the unit square, the point even over the element.
    [[nodiscard]] glm::dvec2 samplePoint(const Node& node, const glm::vec2& u) const;
    [[nodiscard]] glm::dvec2 samplePoint(std::uint32_t element, const glm::vec2& u) const {
        return samplePoint(node(element), u);
    }
    [[nodiscard]] glm::dvec3 samplePosition(std::uint32_t element, const glm::vec2& u) const {
        return positionOn(face(element), samplePoint(element, u));
    }

    // What shoots, and has a row of form factors: each patch, or, where there are none, each
    // element. Patches stay when elements are divided.
    [[nodiscard]] const Patches& patches() const { return m_patches; }
    [[nodiscard]] std::size_t senderCount() const {
        return m_patches.empty() ? size() : m_patches.size();
    }
    [[nodiscard]] std::uint32_t senderOf(std::uint32_t element) const {
        return m_patches.empty() ? element : m_patches.of[element];
    }
    [[nodiscard]] const Node& sender(std::uint32_t sender) const {
        return m_patches.empty() ? node(sender) : m_nodes[sender]; // first grids have first nodes
    }
    [[nodiscard]] std::size_t senderElements(std::uint32_t sender) const { // how many
        return m_patches.empty() ? 1 : m_patches.elementsOf(sender).size();
    }
    // As exposed(): the mean over its area.
    [[nodiscard]] float senderExposed(std::uint32_t sender) const;
    // As isBuried(), of a point in the coordinates of the sender's face.
    [[nodiscard]] bool isSenderBuried(std::uint32_t sender, const glm::dvec2& at,
                                      const RayScene& rays) const;

    // Whether a side of a triangle of the scene is divided; others only absorb, or have no area.
    [[nodiscard]] bool divides(std::uint32_t mesh, std::uint32_t triangle, bool back) const {
        return m_faceOf[m_firstTriangle[mesh] + triangle][back ? 1 : 0] != kNone;
    }
    // The element that a ray has met; kNone: nothing, or a side that only absorbs.
    [[nodiscard]] std::uint32_t met(const ClosestRay& ray) const;
    // The element at a place of a face.
    [[nodiscard]] std::uint32_t elementAt(std::uint32_t face, const glm::dvec2& at) const;

    // Divides each of these elements in four. Numbers change: the answer has for each new element
    // the old one that it is, or is a part of.
    std::vector<std::uint32_t> divide(std::span<const std::uint32_t> elements);
    // Their faces are Face::fenced.
    void setFenced(std::span<const std::uint32_t> elements);

    [[nodiscard]] double metresPerUnit() const { return m_metresPerUnit; }
    [[nodiscard]] std::size_t memoryBytes() const;

  private:
    // Where columns and rows of a face that is cut begin, and 1.
    struct Lines {
        std::vector<float> columns, rows;
    };
    void number();
    // Divides patches until no element is larger. Errors: Usage.
    Result<void> dividePatches(const ElementLimits& limits);

    const BakeGeometry* m_geometry = nullptr;
    std::vector<Face> m_faces;
    std::map<std::uint32_t, Lines> m_lines;             // by face, of those that are cut
    std::vector<std::uint32_t> m_firstTriangle;         // of each mesh, in m_faceOf
    std::vector<std::array<std::uint32_t, 2>> m_faceOf; // of a triangle's front and back
    std::vector<Node> m_nodes;
    std::vector<std::uint32_t> m_elements; // their nodes
    std::vector<double> m_areas;
    std::vector<float> m_exposed;
    std::uint32_t m_patchCount = 0; // the first of m_nodes; 0: there are none
    Patches m_patches;
    double m_metresPerUnit = 1.0;
};

} // namespace patina::radiosity

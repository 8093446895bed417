// Rooms behind doors on both sides of a corridor, of which only some have light: light reaches
// the others through two doors, by way of several surfaces.
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <cmath>
#include <utility>
#include <vector>

namespace patina::library {
namespace {

// Metres. The corridor runs along z, rooms lie to its left (-x) and right.
struct GalleryPlan {
    int roomsPerSide = 3;
    double width = 4.0, depth = 5.0, height = 3.0; // of a room, along z, x and y
    double corridor = 2.0, wall = 0.2;
    double doorWidth = 1.0, doorHeight = 2.1;

    [[nodiscard]] double length() const { // of the corridor
        return roomsPerSide * width + (roomsPerSide - 1) * wall;
    }
    [[nodiscard]] double roomStart(int room) const {
        return room * (width + wall) - 0.5 * length();
    }
    // In the first room on the left and the last one on the right.
    [[nodiscard]] bool hasLight(int side, int room) const {
        return room == (side < 0 ? 0 : roomsPerSide - 1);
    }
};

using Rectangle = std::array<glm::dvec3, 4>; // counter-clockwise from where it is seen

class Gallery {
  public:
    explicit Gallery(const GalleryPlan& plan)
        : m_plan(plan) {}

    std::vector<ModelPart> build() {
        addCorridor();
        for (const int side : {-1, 1})
            for (int room = 0; room < m_plan.roomsPerSide; ++room)
                addRoom(side, room);
        Material light = matteMaterial("Light", glm::vec3(0.78f));
        light.emissive = glm::vec3(1.0f, 0.93f, 0.82f);
        light.emissiveStrength = 20.0f;
        return {
            makePart("Walls", meshOf(m_walls), matteMaterial("White", glm::vec3(0.75f))),
            makePart("Floor", meshOf(m_floor), matteMaterial("Floor", {0.38f, 0.24f, 0.13f})),
            makePart("Red Pictures", meshOf(m_red), matteMaterial("Red", {0.6f, 0.09f, 0.07f})),
            makePart("Blue Pictures", meshOf(m_blue), matteMaterial("Blue", {0.08f, 0.2f, 0.55f})),
            makePart("Plinths", meshOf(m_plinths), matteMaterial("Plinth", glm::vec3(0.6f))),
            makePart("Lights", meshOf(m_lights), light)};
    }

  private:
    using Rectangles = std::vector<Rectangle>;

    // From `corner` along both edges; seen from the side that their cross product points to.
    static void add(Rectangles& to, const glm::dvec3& corner, const glm::dvec3& u,
                    const glm::dvec3& v) {
        to.push_back({corner, corner + u, corner + u + v, corner + v});
    }

    // The outside of a box but for its bottom, and for its back at x = from.x or to.x.
    static void addBox(Rectangles& to, const glm::dvec3& low, const glm::dvec3& high,
                       int withoutSide) {
        const glm::dvec3 size = high - low;
        const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
        add(to, low + y, z, x);
        add(to, low, y, x);
        add(to, low + z, x, y);
        if (withoutSide != -1)
            add(to, low, z, y);
        if (withoutSide != 1)
            add(to, low + x, y, z);
    }

    // A wall along z at `x`, seen from the side `facing` (-1 or 1: of smaller or larger x), with
    // doors that begin at these places.
    void addWallWithDoors(double x, int facing, double from, double to,
                          const std::vector<double>& doors) {
        const double height = m_plan.height, doorHeight = m_plan.doorHeight;
        const auto piece = [&](double z, double y, double length, double tall) {
            const glm::dvec3 corner(x, y, z), along(0, 0, length), up(0, tall, 0);
            if (facing > 0)
                add(m_walls, corner, up, along);
            else
                add(m_walls, corner, along, up);
        };
        double z = from;
        for (const double door : doors) {
            piece(z, 0.0, door - z, height);
            piece(door, doorHeight, m_plan.doorWidth, height - doorHeight);
            z = door + m_plan.doorWidth;
        }
        piece(z, 0.0, to - z, height);
    }

    // A floor and the ceiling above it.
    void addFloorAndCeiling(double x, double z, double width, double length) {
        const glm::dvec3 across(width, 0, 0), along(0, 0, length);
        add(m_floor, {x, 0, z}, along, across);
        add(m_walls, {x, m_plan.height, z}, across, along);
    }

    [[nodiscard]] double doorOf(int room) const {
        return m_plan.roomStart(room) + 0.5 * (m_plan.width - m_plan.doorWidth);
    }

    void addCorridor() {
        const double half = 0.5 * m_plan.corridor, length = m_plan.length();
        const glm::dvec3 across(m_plan.corridor, 0, 0), up(0, m_plan.height, 0);
        addFloorAndCeiling(-half, -0.5 * length, m_plan.corridor, length);
        add(m_walls, {-half, 0, -0.5 * length}, across, up);
        add(m_walls, {-half, 0, 0.5 * length}, up, across);
        std::vector<double> doors;
        for (int room = 0; room < m_plan.roomsPerSide; ++room)
            doors.push_back(doorOf(room));
        for (const int side : {-1, 1})
            addWallWithDoors(side * half, -side, -0.5 * length, 0.5 * length, doors);
    }

    void addRoom(int side, int room) {
        const double half = 0.5 * m_plan.corridor, z = m_plan.roomStart(room), door = doorOf(room);
        const double inner = side * (half + m_plan.wall), outer = inner + side * m_plan.depth;
        const double low = std::min(inner, outer);
        const glm::dvec3 across(m_plan.depth, 0, 0), up(0, m_plan.height, 0),
            along(0, 0, m_plan.width);
        addFloorAndCeiling(low, z, m_plan.depth, m_plan.width);
        add(m_walls, {low, 0, z}, across, up);
        add(m_walls, {low, 0, z + m_plan.width}, up, across);
        addWallWithDoors(inner, side, z, z + m_plan.width, {door});
        addWallWithDoors(outer, -side, z, z + m_plan.width, {});

        // Within the wall: a threshold, what is above it, and two sides.
        const double jamb = std::min(inner, side * half);
        const glm::dvec3 through(m_plan.wall, 0, 0), wide(0, 0, m_plan.doorWidth),
            tall(0, m_plan.doorHeight, 0);
        add(m_floor, {jamb, 0, door}, wide, through);
        add(m_walls, {jamb, m_plan.doorHeight, door}, through, wide);
        add(m_walls, {jamb, 0, door}, through, tall);
        add(m_walls, {jamb, 0, door + m_plan.doorWidth}, tall, through);

        addExhibits(side, outer, low, z, room);
        if (m_plan.hasLight(side, room)) // 10 cm below the ceiling, facing down
            add(m_lights,
                {low + 0.5 * m_plan.depth - 0.6, m_plan.height - 0.1, z + 0.5 * m_plan.width - 0.3},
                {1.2, 0, 0}, {0, 0, 0.6});
    }

    // A picture on the outer wall, 3 cm thick, and two plinths.
    void addExhibits(int side, double outer, double low, double z, int room) {
        constexpr double kThick = 0.03, kPlinth = 0.4;
        const double front = outer - side * kThick, middle = z + 0.5 * m_plan.width;
        Rectangles& pictures = (room + (side > 0 ? 1 : 0)) % 2 == 0 ? m_red : m_blue;
        const glm::dvec3 from(std::min(front, outer), 0.9, middle - 1.1),
            to(std::max(front, outer), 2.3, middle + 1.1);
        addBox(pictures, from, to, side);
        add(pictures, from, {to.x - from.x, 0, 0}, {0, 0, to.z - from.z}); // from below
        for (const double share : {0.35, 0.7}) {
            const double x = low + share * m_plan.depth - 0.5 * kPlinth;
            const double place = middle + (share < 0.5 ? -1.2 : 0.8);
            addBox(m_plinths, {x, 0.0, place}, {x + kPlinth, 1.0, place + kPlinth}, 0);
        }
    }

    // Each rectangle has a cell of the part's unit square of its own, and is not divided.
    static Mesh meshOf(const Rectangles& rectangles) {
        Mesh mesh;
        const int cells =
            static_cast<int>(std::ceil(std::sqrt(static_cast<double>(rectangles.size()))));
        for (std::size_t i = 0; i < rectangles.size(); ++i)
            addQuadGrid(mesh, rectangles[i], 1, cells, static_cast<int>(i));
        return mesh;
    }

    GalleryPlan m_plan;
    Rectangles m_walls, m_floor, m_red, m_blue, m_plinths, m_lights;
};

} // namespace

std::vector<ModelPart> gallery() {
    return Gallery(GalleryPlan()).build();
}

} // namespace patina::library

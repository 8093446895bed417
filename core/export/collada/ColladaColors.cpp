#include "core/export/collada/ColladaColors.h"

#include "core/base/Check.h"
#include "core/export/collada/ColladaElements.h"
#include "core/export/collada/ColladaGeometry.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <string_view>

namespace patina::collada {
namespace {

constexpr const char* kBakeAgain = "another program has changed it since; bake the scene again";

// A lit geometry, and where in the tree its numbers are.
struct Found {
    ColladaLitGeometry lit;
    xml_node geometry, colors; // the latter: the <float_array> of COLOR, set 0
};

std::vector<glm::vec3> vectorsOf(xml_node element) {
    const std::vector<float> numbers = floatsOf(element);
    std::vector<glm::vec3> result;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return result;
}

// The light of its <extra>.
std::vector<glm::vec3> shownRadiosity(xml_node geometry) {
    for (const xml_node& extra : geometry.children("extra"))
        if (isRadiosity(extra))
            for (const xml_node& technique : extra.children("technique")) {
                if (std::string_view(technique.attribute("profile").value()) != "Patina")
                    continue;
                const xml_node white = technique.child(kWhiteRadiosity);
                return vectorsOf(white ? white : technique.child("radiosity"));
            }
    return {};
}

const Input* inputOf(const std::vector<Input>& inputs, std::string_view semantic) {
    const auto found = std::ranges::find_if(
        inputs, [&](const Input& input) { return input.semantic == semantic && input.set == 0; });
    return found != inputs.end() ? &*found : nullptr;
}

// Adds a third of each triangle to the area of its corners.
void addAreas(const Tree& tree, xml_node primitive, const glm::dmat4& toWorld, Found& found) {
    const std::vector<Input> inputs = inputsOf(tree, primitive);
    const Input *position = inputOf(inputs, "POSITION"), *color = inputOf(inputs, "COLOR");
    std::size_t stride = 0;
    for (const Input& input : inputs)
        stride = std::max(stride, input.offset + 1);
    const std::size_t count = found.lit.shown.size();
    const xml_node colors = color != nullptr ? color->source.child("float_array") : xml_node();
    if (position == nullptr || color == nullptr || position->offset != color->offset ||
        std::string_view(primitive.name()) != "triangles" ||
        (found.colors && found.colors != colors))
        throw Fault(fmt::format("{} has no colours that go with its light: {}", describe(primitive),
                                kBakeAgain));
    found.colors = colors;
    const std::vector<glm::vec3> positions = vectorsOf(position->source.child("float_array"));
    const std::vector<std::uint32_t> indices = indicesOf(primitive.child("p"));
    if (positions.size() != count || floatsOf(colors).size() != 4 * count)
        throw Fault(fmt::format("{} has light of {} vertices, {} positions and {} colours: {}",
                                describe(found.geometry), count, positions.size(),
                                floatsOf(colors).size() / 4, kBakeAgain));
    for (std::size_t i = 0; i + 3 * stride <= indices.size(); i += 3 * stride) {
        std::array<std::uint32_t, 3> corners{};
        std::array<glm::dvec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = indices[i + k * stride + position->offset];
            if (corners[k] >= count)
                throw Fault(fmt::format("an index of {} is beyond its {} vertices",
                                        describe(primitive), count));
            at[k] = glm::dvec3(toWorld * glm::dvec4(positions[corners[k]], 1.0));
        }
        const double area = 0.5 * glm::length(glm::cross(at[1] - at[0], at[2] - at[0]));
        for (const std::uint32_t corner : corners)
            found.lit.areas[corner] += area / 3.0;
    }
}

std::vector<Found> find(const Tree& tree, const SceneContents& contents) {
    std::vector<Found> result;
    for (std::size_t i = 0; i < contents.places.size(); ++i) {
        const Place& place = contents.places[i];
        if (std::ranges::none_of(place.geometry.children("extra"), isRadiosity))
            continue;
        auto found = std::ranges::find(result, place.geometry, &Found::geometry);
        if (found == result.end()) {
            Found& added = result.emplace_back();
            added.geometry = place.geometry;
            added.lit.id = place.geometry.attribute("id").value();
            added.lit.shown = shownRadiosity(place.geometry);
            added.lit.areas.assign(added.lit.shown.size(), 0.0);
            found = result.end() - 1;
        }
        addAreas(tree, place.primitive, contents.instances[i].toWorld, *found);
    }
    return result;
}

} // namespace

std::vector<ColladaLitGeometry> litGeometries(const Tree& tree, const SceneContents& contents) {
    std::vector<ColladaLitGeometry> result;
    for (Found& found : find(tree, contents))
        result.push_back(std::move(found.lit));
    return result;
}

void recolor(const Tree& tree, const SceneContents& contents,
             std::span<const std::vector<glm::vec4>> colors) {
    const std::vector<Found> found = find(tree, contents);
    CHECK_EQ(found.size(), colors.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK_EQ(found[i].lit.shown.size(), colors[i].size());
        setText(found[i].colors, numbersText(colors[i]));
    }
}

} // namespace patina::collada

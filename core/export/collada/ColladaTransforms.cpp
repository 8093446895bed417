#include "core/export/collada/ColladaTransforms.h"

#include "core/export/Names.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace patina::collada {
namespace {

glm::dvec3 vectorAt(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

glm::dvec3 axisAt(const std::vector<double>& numbers, std::size_t first, xml_node element) {
    const glm::dvec3 axis = vectorAt(numbers, first);
    const double length = glm::length(axis);
    if (!(length > 0.0) || !std::isfinite(length))
        throw Fault(fmt::format("an axis of {} has no direction; export the scene again",
                                describe(element)));
    return axis / length;
}

// Moves points along axis b so that axis a turns towards b by the angle, as RenderMan's Skew does,
// which COLLADA takes it from ("The RenderMan Interface" 3.2, section 5.4): x + k (n·x) b, where n
// is the direction of the part of a that is perpendicular to b.
glm::dmat4 skewMatrix(xml_node element) {
    const std::vector<double> numbers = doublesOf(element, 7);
    const double angle = glm::radians(numbers[0]);
    const glm::dvec3 a = axisAt(numbers, 1, element), b = axisAt(numbers, 4, element);
    const double along = glm::dot(a, b);
    const glm::dvec3 perpendicular = a - b * along;
    const double across = glm::length(perpendicular);
    // The turned axis, in the plane of b and n.
    const double x = along * std::cos(angle) + across * std::sin(angle);
    const double y = across * std::cos(angle) - along * std::sin(angle);
    if (!(across > 1e-9) || !(y > 1e-9)) // axes of one direction; turned as far as axis b
        throw Fault(fmt::format("{} cannot be a skew: its angle reaches the axis of translation; "
                                "export the scene with matrices",
                                describe(element)));
    const double k = x / y - along / across;
    const glm::dvec3 n = perpendicular / across;
    glm::dmat4 result(1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            result[column][row] += k * b[row] * n[column];
    return result;
}

// The eye at a point, looking along -Z at another: what lookAt takes to the origin comes from
// there.
glm::dmat4 lookAtMatrix(xml_node element) {
    const std::vector<double> numbers = doublesOf(element, 9);
    const glm::dvec3 eye = vectorAt(numbers, 0), point = vectorAt(numbers, 3);
    const glm::dvec3 up = axisAt(numbers, 6, element);
    if (!(glm::length(glm::cross(point - eye, up)) > 0.0))
        throw Fault(fmt::format("{} looks nowhere, or straight along its up direction; export the "
                                "scene with matrices",
                                describe(element)));
    return glm::inverse(glm::lookAt(eye, point, up));
}

} // namespace

glm::dmat4 transformOf(xml_node node) {
    glm::dmat4 result(1.0);
    for (const xml_node& child : node.children()) {
        const std::string_view name = child.name();
        if (name == "matrix") {
            const std::vector<double> rows = doublesOf(child, 16);
            glm::dmat4 matrix;
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column)
                    matrix[column][row] = rows[static_cast<std::size_t>(row * 4 + column)];
            if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 ||
                matrix[3][3] != 1.0)
                throw Fault(fmt::format("the last row of {} is not 0 0 0 1; export the scene again",
                                        describe(child)));
            result = result * matrix;
        } else if (name == "translate") {
            result = glm::translate(result, vectorAt(doublesOf(child, 3), 0));
        } else if (name == "rotate") {
            const std::vector<double> numbers = doublesOf(child, 4);
            if (numbers[3] != 0.0 && vectorAt(numbers, 0) != glm::dvec3(0.0))
                result = glm::rotate(result, glm::radians(numbers[3]), axisAt(numbers, 0, child));
        } else if (name == "scale") {
            result = glm::scale(result, vectorAt(doublesOf(child, 3), 0));
        } else if (name == "skew") {
            result = result * skewMatrix(child);
        } else if (name == "lookat") {
            result = result * lookAtMatrix(child);
        }
    }
    return result;
}

glm::dmat4 assetTransform(const Tree& tree) {
    const xml_node asset = tree.root().child("asset");
    double metres = 1.0;
    if (const xml_node unit = asset.child("unit"); unit.attribute("meter")) {
        const std::string text = trimmed(unit.attribute("meter").value());
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), metres);
        if (error != std::errc() || end != text.data() + text.size() || !(metres > 0.0) ||
            !std::isfinite(metres))
            throw Fault(
                fmt::format("its <unit> is \"{}\" metres; set it to a positive number, with a dot",
                            cleanName(unit.attribute("meter").value(), "")));
    }
    const std::string up = trimmed(textOf(asset.child("up_axis")));
    glm::dmat4 axes(1.0);
    if (up == "Z_UP") { // right +X, up +Z, towards the viewer -Y
        axes[1] = {0.0, 0.0, -1.0, 0.0};
        axes[2] = {0.0, 1.0, 0.0, 0.0};
    } else if (up == "X_UP") { // right -Y, up +X, towards the viewer +Z
        axes[0] = {0.0, 1.0, 0.0, 0.0};
        axes[1] = {-1.0, 0.0, 0.0, 0.0};
    } else if (!up.empty() && up != "Y_UP") {
        throw Fault(fmt::format("its <up_axis> is \"{}\"; set it to X_UP, Y_UP or Z_UP",
                                cleanName(up, "")));
    }
    return glm::scale(axes, glm::dvec3(metres));
}

bool isInvertible(const glm::dmat4& matrix) {
    const glm::dmat3 m(matrix);
    double lengths = 1.0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    for (int column = 0; column < 3; ++column)
        lengths *= glm::length(m[column]);
    return lengths > 0.0 && std::abs(glm::determinant(m)) > 1e-12 * lengths;
}

} // namespace patina::collada

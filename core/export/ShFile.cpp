#include "core/export/ShFile.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kOrder = "index l(l+1)+m: l = 0, 1 …, m = -l … l";
constexpr const char* kFrame = "right-handed, +Y up; the middle of a lat-long image is -Z";

int orderOf(std::size_t count) {
    const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
    CHECK_EQ(static_cast<std::size_t>(shCount(order)), count);
    return order;
}

const char* nameOf(ShQuantity quantity) {
    return quantity == ShQuantity::Radiance ? "radiance" : "irradiance";
}

const char* formulaOf(ShQuantity quantity) {
    return quantity == ShQuantity::Radiance
               ? "L(d) = sum of c_i Y_i(d), truncated; c_i = integral of L(d) Y_i(d) over the "
                 "sphere; white light of radiance 1 has c_0 = 3.54491"
               : "E(n) = sum of c_i Y_i(n); c_lm = A_l L_lm with A = pi, 2pi/3, pi/4; white light "
                 "of radiance 1 has c_0 = 11.1367; a Lambertian surface reflects albedo E / pi";
}

// As doubles whose shortest text is the float's, not its 17 digits.
Json toJson(const glm::vec3& v) {
    Json array = Json::array();
    for (int i = 0; i < 3; ++i)
        array.push_back(std::stod(fmt::format("{}", v[i])));
    return array;
}

} // namespace

std::string shJson(std::span<const glm::vec3> coefficients, ShQuantity quantity) {
    const int order = orderOf(coefficients.size());
    Json root;
    root["format"] = "patina-spherical-harmonics";
    root["version"] = 1;
    root["quantity"] = nameOf(quantity);
    root["formula"] = formulaOf(quantity);
    root["basis"] = kShBasisText;
    root["order"] = kOrder;
    root["frame"] = kFrame;
    root["color"] = "linear, Rec. 709 primaries: R, G, B";
    root["bands"] = order;
    Json& list = root["coefficients"] = Json::array();
    for (const glm::vec3& c : coefficients)
        list.push_back(toJson(c));

    Json& axes = root["axes"] = Json::object();
    const std::array<std::pair<const char*, glm::vec3>, 6> directions = {{{"+X", {1, 0, 0}},
                                                                          {"-X", {-1, 0, 0}},
                                                                          {"+Y", {0, 1, 0}},
                                                                          {"-Y", {0, -1, 0}},
                                                                          {"+Z", {0, 0, 1}},
                                                                          {"-Z", {0, 0, -1}}}};
    std::vector<float> y(coefficients.size());
    for (const auto& [name, direction] : directions) {
        evaluateSh(order, direction, y);
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < y.size(); ++i)
            sum += coefficients[i] * y[i];
        axes[name] = toJson(sum);
    }
    return root.dump(2) + "\n";
}

std::string shText(std::span<const glm::vec3> coefficients, ShQuantity quantity) {
    const int order = orderOf(coefficients.size());
    std::string text =
        fmt::format("# Spherical harmonics of {}, {} bands\n# {}\n# {}\n# {}\n# {}\n"
                    "# l m R G B, linear, Rec. 709 primaries\n",
                    nameOf(quantity), order, formulaOf(quantity), kShBasisText, kOrder, kFrame);
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m) {
            const glm::vec3& c = coefficients[static_cast<std::size_t>(shIndex(l, m))];
            text += fmt::format("{} {} {:.9g} {:.9g} {:.9g}\n", l, m, c.x, c.y, c.z);
        }
    return text;
}

} // namespace patina

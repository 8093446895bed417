#include "app/cli/LeakReport.h"

#include "app/cli/Report.h"
#include "core/radiosity/document/LeaksAndSeams.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

constexpr std::size_t kListedInText = 5, kListedInJson = 1000;

nlohmann::ordered_json positionJson(const glm::vec3& at) {
    return {at.x, at.y, at.z};
}

std::string lengthText(double metres) {
    return metres < 0.01 ? fmt::format("{:.2g} mm", 1e3 * metres)
                         : fmt::format("{:.2g} cm", 1e2 * metres);
}

class ReportedElements {
  public:
    ReportedElements(const RadiosityInputs& inputs, const RadiosityScene& scene)
        : m_inputs(inputs)
        , m_scene(scene) {}
    [[nodiscard]] std::string mesh(std::uint32_t element) const {
        const Id id = m_scene.scene().meshId(m_scene.elements().face(element).mesh);
        const MeshInstance* mesh = m_inputs.document.mesh(id);
        return mesh != nullptr ? mesh->name : std::string();
    }
    [[nodiscard]] std::string text(std::uint32_t element) const {
        return fmt::format("{}, element {}", mesh(element), element);
    }

  private:
    const RadiosityInputs& m_inputs;
    const RadiosityScene& m_scene;
};

} // namespace

Result<void> reportLeaksAndSeams(Session& session, const RadiosityInputs& inputs,
                                 const RadiositySettings& settings, const SolvedRadiosity& solved) {
    session.beginPhase();
    const RadiosityScene& scene = *solved.scene;
    const radiosity::LitMesh mesh =
        radiosity::litMesh(scene.elements(), *scene.scene().geometry(), *scene.scene().rays());
    const SolvedElements searched{
        scene.scene(),         scene.elements(),     mesh, scene.lit(), solved.solved.solution,
        settings.lightSamples, settings.factors.seed};
    const auto leaks = findLeaks(searched, session.job());
    if (!leaks)
        return leaks.error();
    const auto seams = findSeams(searched, session.job());
    if (!seams)
        return seams.error();

    const ReportedElements elements(inputs, scene);
    nlohmann::ordered_json& json = session.report().json();
    double power = 0.0;
    auto listed = nlohmann::ordered_json::array();
    std::vector<std::pair<std::string, std::string>> rows{{"Leaks", countText(leaks->size())}};
    for (const LightLeak& leak : *leaks) {
        power += leak.power;
        const bool divided = leak.kind == LightLeak::Kind::Divided;
        if (listed.size() < kListedInJson) {
            listed.push_back({{"kind", divided ? "divided" : "gap"},
                              {"mesh", elements.mesh(leak.element)},
                              {"element", leak.element},
                              {"power", leak.power},
                              {"position", positionJson(leak.place)}});
            if (divided)
                listed.back()["share"] = leak.share;
            else
                listed.back()["width"] = leak.width;
        }
        if (rows.size() <= kListedInText)
            rows.emplace_back(
                "  " + elements.text(leak.element),
                divided ? fmt::format("{:.2g} W, divided by what stands on it: {:.0f} % of it are "
                                      "on the other side",
                                      leak.power, 100.0 * leak.share)
                        : fmt::format("{:.2g} W through a gap of {}", leak.power,
                                      lengthText(leak.width)));
    }
    json["leaks"] = {{"count", leaks->size()}, {"power", power}, {"list", std::move(listed)}};
    listed = nlohmann::ordered_json::array();
    const std::size_t before = rows.size();
    rows.emplace_back("Seams", countText(seams->size()));
    for (const LightSeam& seam : *seams) {
        if (listed.size() < kListedInJson)
            listed.push_back({{"mesh", elements.mesh(seam.element)},
                              {"element", seam.element},
                              {"otherMesh", elements.mesh(seam.other)},
                              {"otherElement", seam.other},
                              {"jump", seam.jump},
                              {"share", seam.share},
                              {"width", seam.width},
                              {"length", seam.length},
                              {"position", positionJson(seam.place)}});
        if (rows.size() - before <= kListedInText)
            rows.emplace_back(fmt::format("  {}", elements.text(seam.element)),
                              fmt::format("{:.2g} W/m² ({:.0f} %) to {}{}", seam.jump,
                                          100.0 * seam.share, elements.text(seam.other),
                                          seam.width > 0.0
                                              ? fmt::format(", {} apart", lengthText(seam.width))
                                              : std::string(", not joined")));
    }
    json["seams"] = {{"count", seams->size()}, {"list", std::move(listed)}};
    session.report().table({}, rows);
    return {};
}

} // namespace patina::cli

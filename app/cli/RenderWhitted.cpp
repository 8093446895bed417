#include "app/cli/RenderWhitted.h"

#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/TracingOptions.h"
#include "app/cli/Vectors.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace patina::cli {
namespace {

// Of what is not in the document any more, or never was: its number.
template <class Thing>
std::string nameOf(const Thing* thing, Id id) {
    return thing != nullptr ? thing->name : fmt::format("{}", id);
}

nlohmann::ordered_json rayNodeJson(const Document& document, const RayTree& tree, std::size_t index,
                                   const glm::vec3& subtotal) {
    const RayNode& node = tree.nodes()[index];
    nlohmann::ordered_json json = {{"id", index},
                                   {"parent", node.parent >= 0 ? nlohmann::ordered_json(node.parent)
                                                               : nlohmann::ordered_json()},
                                   {"kind", rayKindInfo(node.kind).id},
                                   {"end", rayEndInfo(node.end).id},
                                   {"why", rayEndInfo(node.end).text},
                                   {"cast", wasCast(node.end)},
                                   {"depth", node.depth},
                                   {"origin", vectorJson(node.origin)},
                                   {"direction", vectorJson(node.direction)}};
    if (node.kind == RayKind::Camera) {
        json["at"] = {node.at.x, node.at.y};
        json["share"] = node.share;
    }
    if (node.light != 0)
        json["light"] = nameOf(document.light(node.light), node.light);
    if (node.glowing != 0)
        json["emissiveMesh"] = nameOf(document.mesh(node.glowing), node.glowing);
    if (node.kind == RayKind::Shadow && node.end == RayEnd::Lit)
        json["passes"] = vectorJson(node.passes);
    if (!std::isinf(node.distance))
        json["distance"] = node.distance;
    if (node.hit) {
        json["position"] = vectorJson(node.position);
        json["normal"] = vectorJson(node.normal);
        json["mesh"] = nameOf(document.mesh(node.mesh), node.mesh);
        json["material"] = nameOf(document.material(node.material), node.material);
    }
    if (node.etaRatio > 0.0f) {
        json["cosIncident"] = node.cosIncident;
        json["etaRatio"] = node.etaRatio;
        json["totalReflection"] = node.totalReflection;
    }
    const RayTerms& terms = node.terms;
    if (node.kind == RayKind::Reflected || node.kind == RayKind::Refracted)
        json[node.kind == RayKind::Reflected ? "kr" : "kt"] = vectorJson(terms.factor);
    if (node.kind == RayKind::Shadow && terms.arriving != glm::vec3(0.0f)) {
        json["arriving"] = vectorJson(terms.arriving);
        json["diffuse"] = vectorJson(terms.diffuse);
        json["specular"] = vectorJson(terms.specular);
    }
    if (node.kind != RayKind::Shadow && node.hit) {
        json["ambientLight"] = vectorJson(terms.ambientLight);
        json["ambient"] = vectorJson(terms.ambient);
        json["emission"] = vectorJson(terms.emission);
    }
    json["weight"] = vectorJson(node.weight);
    json["contribution"] = vectorJson(node.contribution);
    json["subtotal"] = vectorJson(subtotal);
    return json;
}

std::string rayNodeText(const Document& document, const RayNode& node, const glm::vec3& subtotal) {
    std::string text(
        2 * static_cast<std::size_t>(node.depth) + (node.kind == RayKind::Shadow ? 2 : 0), ' ');
    text += rayKindInfo(node.kind).text;
    if (node.kind == RayKind::Camera)
        text += fmt::format(" at {:g},{:g} of the pixel", node.at.x, node.at.y);
    if (node.light != 0)
        text += fmt::format(" to {}", nameOf(document.light(node.light), node.light));
    if (node.glowing != 0)
        text += fmt::format(" to {}", nameOf(document.mesh(node.glowing), node.glowing));
    if (node.hit)
        text += fmt::format(", {} at {:.4g} m", nameOf(document.mesh(node.mesh), node.mesh),
                            node.distance);
    if (node.totalReflection)
        text += ", total reflection";
    text += fmt::format(": adds {}", vectorText(node.contribution));
    if (node.kind == RayKind::Camera)
        text += fmt::format(", with all below {}", vectorText(subtotal));
    if (node.end != RayEnd::Continues)
        text += fmt::format(" ({})", rayEndInfo(node.end).text);
    return text;
}

} // namespace

Result<void> checkWhitted(const RenderOptions& options) {
    if (!isWhitted(options))
        return options.rayTree.empty() ? Result<void>()
                                       : usageError("--ray-tree is for --renderer whitted");
    if (options.aov.empty())
        return {};
    if (const auto counts = parseRayCounts(options.aov); !counts)
        return counts.error();
    if (!options.work.shard.empty() || !options.work.checkpoint.empty() || options.work.resume)
        return usageError("--aov with --renderer whitted counts a whole picture in one run; "
                          "leave --shard, --checkpoint and --resume out");
    return {};
}

void addSettings(const WhittedSettings& settings, StateSettings& to) {
    to["renderer"] = "whitted";
    to["whitted-model"] = whittedModelName(settings.model);
    to["max-bounces"] = std::to_string(settings.maxDepth);
    to["min-contribution"] = fmt::format("{}", settings.minContribution);
    if (settings.softShadows)
        to["soft-shadows"] = "on";
    if (settings.gloss)
        to["gloss"] = "on";
    if (settings.depthOfField)
        to["depth-of-field"] = "on";
    if (!settings.isStochastic()) {
        to["contrast"] = fmt::format("{}", settings.contrast);
        to["subdivisions"] = std::to_string(settings.subdivisions);
    }
}

Result<WhittedPicture> WhittedPicture::prepare(const TraceScene& scene, const TraceView& view,
                                               const WhittedSettings& settings,
                                               std::vector<const RayCountInfo*> counts,
                                               const JobContext& job) {
    WhittedPicture picture(scene, view, settings);
    if (!counts.empty())
        picture.m_map.emplace(view.width, view.height);
    if (needHierarchy(counts) && scene.geometry() != nullptr) {
        picture.m_hierarchy = TeachingHierarchy::build(*scene.geometry(), job);
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    }
    picture.m_counts = std::move(counts);
    return picture;
}

FilmPass WhittedPicture::pass() {
    return [this](Film& film, std::uint32_t first, std::uint32_t count, const JobContext& job,
                  const TraceTiles& tiles) {
        return traceWhitted(*m_scene, *m_view, m_settings, film, first, count, job, m_rays.get(),
                            tiles, m_map ? &*m_map : nullptr,
                            m_hierarchy ? &*m_hierarchy : nullptr);
    };
}

std::vector<ImagePart> WhittedPicture::parts() const {
    const std::size_t triangles =
        m_scene->geometry() != nullptr ? m_scene->geometry()->triangleCount() : 0;
    std::vector<ImagePart> parts;
    for (const RayCountInfo* info : m_counts) {
        ImagePart part;
        part.name = info->id;
        part.image = rayCountImage(info->kind, *m_map, m_view->width, m_view->height, triangles);
        part.attributes["patina:view"] = info->label;
        parts.push_back(std::move(part));
    }
    return parts;
}

void WhittedPicture::describe(nlohmann::ordered_json& json) const {
    json["rays"] = m_rays->count.load();
    if (!m_map)
        return;
    std::uint64_t boxes = 0, triangles = 0;
    std::uint32_t depth = 0;
    for (const RayCounts& pixel : m_map->pixels()) {
        boxes += pixel.boxTests;
        triangles += pixel.triangleTests;
        depth = std::max(depth, pixel.depth);
    }
    json["rayDepth"] = depth;
    if (m_hierarchy) {
        json["hierarchy"] = {{"boxes", m_hierarchy->boxCount()},
                             {"levels", m_hierarchy->levels()},
                             {"triangles", m_hierarchy->triangleCount()},
                             {"boxTests", boxes},
                             {"triangleTests", triangles}};
    }
}

void reportRayTree(Session& session, const Document& document, const RayTree& tree,
                   const glm::ivec2& pixel) {
    const std::vector<glm::vec3> subtotals = tree.subtotals();
    nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
    std::string text = fmt::format("Rays of pixel {},{}: {}, of {} camera rays", pixel.x, pixel.y,
                                   vectorText(tree.radiance()), tree.sampleCount());
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        nodes.push_back(rayNodeJson(document, tree, i, subtotals[i]));
        text += "\n" + rayNodeText(document, tree.nodes()[i], subtotals[i]);
    }
    session.report().json()["rayTree"] = {{"pixel", {pixel.x, pixel.y}},
                                          {"radiance", vectorJson(tree.radiance())},
                                          {"samples", tree.sampleCount()},
                                          {"nodes", std::move(nodes)}};
    session.report().line(text);
}

} // namespace patina::cli

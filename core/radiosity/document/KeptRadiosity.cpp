#include "core/radiosity/document/KeptRadiosity.h"

#include "core/base/Check.h"
#include "core/radiosity/file/RadiosityFile.h"
#include "core/trace/BakeSurface.h"
#include "core/trace/path/TraceHash.h"

#include <cstdint>
#include <span>

namespace patina {

using namespace radiosity;

namespace {

// Changes whenever a solution or a division would come to something else, or the files are laid out
// otherwise.
constexpr std::uint32_t kSolutionAlgorithm = 1;

// All of the settings that a solution of given elements and a division follow from. Limits (of
// elements, of bytes) are left out: they end a solution, and change none.
void hashSettings(Hasher& hasher, const RadiositySettings& settings) {
    hasher.value(kSolutionAlgorithm)
        .value(settings.maxArea)
        .value(settings.adaptive)
        .value(static_cast<std::int32_t>(settings.divideBy))
        .value(static_cast<std::int32_t>(settings.dynamic))
        .value(settings.patchArea)
        .value(settings.lightSamples)
        .value(settings.factors.seed)
        .value(static_cast<std::int32_t>(settings.classic))
        .value(static_cast<std::int32_t>(settings.solve.solver))
        .value(settings.solve.residual)
        .value(std::uint64_t{settings.solve.shotsPerStep});
    if (settings.solve.solver == Solver::Hierarchical) {
        const HierarchySettings& hierarchy = settings.hierarchy;
        hasher.value(hierarchy.linkError).value(hierarchy.pairs).value(hierarchy.seed);
        return;
    }
    const FactorSettings& factors = settings.factors;
    hasher.value(static_cast<std::int32_t>(factors.method))
        .value(factors.resolution)
        .value(static_cast<std::int32_t>(factors.centreOnly))
        .value(factors.stands)
        .value(static_cast<std::int32_t>(factors.drawer != nullptr)); // it rounds as it likes
}

// What rays meet, from which side.
void hashGeometry(Hasher& hasher, const TraceInputs& inputs) {
    for (const TraceMesh& mesh : inputs.meshes) {
        const Material& material = inputs.materials.at(mesh.material);
        hasher.value(mesh.mesh ? hashMesh(*mesh.mesh) : Hash{});
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                hasher.value(mesh.transform[column][row]);
        hasher.value(static_cast<std::int32_t>(material.doubleSided));
        hashCoverage(hasher, bakeSurface(material));
    }
}

void hashLights(Hasher& hasher, const std::vector<Light>& lights, const Hash& content) {
    hasher.value(std::uint64_t{lights.size()}).value(content);
    for (const Light& light : lights)
        hasher.value(static_cast<std::uint64_t>(light.id));
}

// Has an adaptive division from a cache, or else takes note of how it is made.
class DivisionKeeper final : public MemoryKeeper {
  public:
    // False: `division` is of other elements, and these are divided only in part.
    [[nodiscard]] bool fits() const { return m_fits; }
    void take(const KeptDivision& division) { m_division = division; }

    Result<void> divide(ElementMesh& elements) override {
        m_fits = divideAgain(m_division, elements);
        return {};
    }

  private:
    KeptDivision m_division;
    bool m_fits = true;
};

} // namespace

Hash divisionKey(const TraceInputs& inputs, const RadiositySettings& settings) {
    Hasher hasher;
    hasher.text("division");
    hashSettings(hasher, settings);
    hashGeometry(hasher, inputs);
    const TraceHash content = hashTraceInputs(inputs);
    hasher.value(content.materials).value(content.environment);
    hashLights(hasher, inputs.lights, content.lights);
    return hasher.finish();
}

Result<std::unique_ptr<RadiosityScene>> divideByLight(const TraceInputs& inputs,
                                                      const RadiositySettings& settings,
                                                      const SolutionCache* cache,
                                                      std::optional<NamedDivision>& division,
                                                      FactorMatrix& rows, const JobContext& job) {
    const Hash key = cache != nullptr ? divisionKey(inputs, settings) : Hash{};
    auto kept = cache != nullptr ? cache->findDivision(key) : std::nullopt;
    if (kept) {
        DivisionKeeper keeper;
        keeper.take(*kept);
        auto scene = RadiosityScene::divideAsKept(inputs, settings, job, &keeper);
        if (!scene)
            return scene;
        const bool same = keeper.fits() && hashElements((*scene)->elements()) == kept->elements;
        if (same && (*scene)->elements().size() <= settings.maxElements) {
            division = {key, *std::move(kept)};
            return scene;
        }
        if (!same)
            cache->drop(key);
    }
    DivisionKeeper keeper;
    auto scene = RadiosityScene::make(inputs, settings, job, &keeper);
    if (scene)
        rows = std::move(keeper.state().rows);
    if (scene && cache != nullptr && keeper.state().divided)
        division = {key, {std::move(keeper.state().divisions), hashElements((*scene)->elements())}};
    return scene;
}

SolutionKeys::SolutionKeys(const LiveRadiosity& live)
    : m_live(live) {
    Hasher hasher;
    hashSettings(hasher, live.settings);
    hashGeometry(hasher, live.inputs);
    m_elements = hasher.value(hashElements(live.elements()))
                     .array(std::span(live.lit.problem.reflectance))
                     .finish();
}

Hash SolutionKeys::of(const RadiositySource& source) const {
    Hasher hasher;
    hasher.text("source").value(m_elements).value(static_cast<std::int32_t>(source.kind));
    TraceInputs own;
    own.lights = source.lights;
    own.environments = source.environments;
    if (source.kind == RadiositySource::Kind::Glow) {
        own.meshes = m_live.inputs.meshes;
        own.materials = m_live.inputs.materials;
    }
    const TraceHash content = hashTraceInputs(own);
    hasher.value(content.materials).value(content.environment);
    hashLights(hasher, own.lights, content.lights);
    return hasher.finish();
}

Result<void> keepRadiosity(const LiveRadiosity& live, const SolutionCache& cache) {
    CHECK(live.solved);
    if (const std::optional<NamedDivision>& division = live.shape->division;
        division && !cache.has(division->key))
        if (Result<void> stored = cache.store(division->key, division->kept); !stored)
            return stored;
    const SolutionKeys keys(live);
    for (const RadiositySource& source : live.sources) {
        const Hash key = keys.of(source);
        if (cache.has(key))
            continue;
        if (Result<void> stored = cache.store(
                key, KeptSolution{source.direct, source.bounced, source.residual, source.sweeps});
            !stored)
            return stored;
    }
    return {};
}

} // namespace patina

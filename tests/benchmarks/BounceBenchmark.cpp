// What following bounces again costs after an edit of albedo: for the light shown, per bounce, and
// for all coefficients, against the bake that it saves.
#include "core/bake/Bake.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/library/Library.h"
#include "core/library/Meshes.h"

#include <benchmark/benchmark.h>
#include <ctime>

using namespace patina;

namespace {

constexpr int kBounces = 3;

// CPU time of all threads of the process.
double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

BakeInputs inputsOf(Mesh mesh) {
    (void)sanitizeMesh(mesh);
    BakeInputs inputs;
    inputs.meshes.push_back(
        {1, 1, std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f), false, {}});
    return inputs;
}

// 100,000 vertices, a third of whose rays meet the knot again …
const BakeInputs& knot() {
    static const BakeInputs inputs = inputsOf(library::makeTorusKnot(3124, 32));
    return inputs;
}

// … and as many from the inside of a sphere, where every ray ends on a surface; `mapped`: with an
// image for its colour.
BakeInputs enclosure(bool mapped) {
    Mesh mesh = library::makeSphere(446, 223);
    for (glm::vec3& normal : mesh.normals)
        normal = -normal;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    BakeInputs inputs = inputsOf(std::move(mesh));
    if (mapped) {
        auto image = std::make_shared<Image>(1024, 1024, 3, PixelType::U8, ColorEncoding::Srgb);
        for (std::size_t i = 0; i < image->u8().size(); ++i)
            image->u8()[i] = std::uint8_t(128 + i * 37 % 128);
        inputs.meshes[0].surface.baseColorMap.image = image;
    }
    return inputs;
}

// What a wall is recoloured in.
BakeInputs cornellBox() {
    BakeInputs inputs;
    const Result<std::vector<library::ModelPart>> parts = library::model("cornell-box");
    for (const library::ModelPart& part : *parts) {
        BakeMesh& mesh = inputs.meshes.emplace_back();
        mesh.id = mesh.material = Id(inputs.meshes.size());
        mesh.mesh = part.mesh;
        mesh.surface = bakeSurface(part.material);
    }
    return inputs;
}

// A bake once, with what it took and the hits it left.
struct Baked : TileSink {
    Baked(const BakeInputs& scene, int order, int samples)
        : inputs(scene) {
        PrtSettings settings;
        settings.order = order;
        settings.samples = samples;
        settings.transfer = TransferKind::Interreflected;
        settings.bounces = kBounces;
        settings.bounceSamples = 64;
        settings.fitted = false;
        const double begin = cpuSeconds();
        artifact = *bakePrtVertex(inputs, settings, *this, {});
        seconds = cpuSeconds() - begin;
        solver = std::make_unique<BounceSolver>(source);
        solver->setSurfaces(surfacesOf(source->elements(), inputs), {});
    }
    void hits(const HitSourcePtr& hits) override { source = hits; }
    [[nodiscard]] std::size_t vertexCount() const { return source->elements().fronts(); }

    BakeInputs inputs;
    BakeArtifact artifact;
    HitSourcePtr source;
    std::unique_ptr<BounceSolver> solver;
    double seconds = 0.0;
};

void describe(benchmark::State& state, const Baked& baked) {
    state.counters["vertices"] = double(baked.vertexCount());
    state.counters["hits/ray"] = double(static_cast<const HitCache&>(*baked.source).hitBytes()) /
                                 8.0 / double(baked.vertexCount()) /
                                 baked.source->settings().samples;
}

// A drag: other numbers every time, the same maps.
void recolour(Baked& baked, int step) {
    baked.inputs.meshes[0].surface.baseColor.g = 0.2f + 0.01f * float(step % 50);
    baked.solver->setSurfaces(surfacesOf(baked.source->elements(), baked.inputs), {});
}

void lightShown(benchmark::State& state, const BakeInputs& inputs) {
    Baked baked(inputs, 1, 32);
    const std::vector<glm::vec3> direct(baked.vertexCount(), glm::vec3(0.5f));
    double cpu = 0.0;
    int step = 0;
    for (auto _ : state) {
        const double begin = cpuSeconds();
        recolour(baked, ++step);
        benchmark::DoNotOptimize(baked.solver->solveLight(direct, {}, kBounces, {}));
        cpu += cpuSeconds() - begin;
    }
    describe(state, baked);
    state.counters["CPU ms/bounce"] = 1e3 * cpu / double(state.iterations()) / kBounces;
}

void allCoefficients(benchmark::State& state, const BakeInputs& inputs) {
    Baked baked(inputs, int(state.range(0)), int(state.range(1)));
    const std::vector<float> direct = *directTransfer(baked.source->elements(), baked.artifact);
    double cpu = 0.0;
    int step = 0;
    for (auto _ : state) {
        const double begin = cpuSeconds();
        recolour(baked, ++step);
        benchmark::DoNotOptimize(baked.solver->solve(direct, kBounces, {}));
        cpu += cpuSeconds() - begin;
    }
    describe(state, baked);
    state.counters["CPU s"] = cpu / double(state.iterations());
    state.counters["bake CPU s"] = baked.seconds;
    state.counters["share of bake"] = cpu / double(state.iterations()) / baked.seconds;
}

void lightShownKnot(benchmark::State& state) {
    lightShown(state, knot());
}
void lightShownEnclosure(benchmark::State& state) {
    lightShown(state, enclosure(false));
}
void lightShownMappedEnclosure(benchmark::State& state) {
    lightShown(state, enclosure(true));
}
void allCoefficientsKnot(benchmark::State& state) {
    allCoefficients(state, knot());
}
void allCoefficientsCornellBox(benchmark::State& state) {
    allCoefficients(state, cornellBox());
}
void allCoefficientsEnclosure(benchmark::State& state) {
    allCoefficients(state, enclosure(false));
}

} // namespace

BENCHMARK(lightShownKnot)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(lightShownEnclosure)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(lightShownMappedEnclosure)->UseRealTime()->Unit(benchmark::kMillisecond);
// Order, rays per vertex.
BENCHMARK(allCoefficientsCornellBox)
    ->Args({3, 256})
    ->Args({5, 256})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(allCoefficientsKnot)
    ->Args({3, 256})
    ->Args({5, 256})
    ->Args({5, 1024})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(allCoefficientsEnclosure)
    ->Args({5, 1024})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// What a transfer bake takes at its peak beyond what was there before, against what cannot be done
// without: the coefficients and the hierarchy of the rays. Figures of resident memory (Linux), so
// pages that the allocator keeps count too.
#include "core/bake/Bake.h"
#include "core/bake/file/BakeIO.h"
#include "core/document/Document.h"
#include "core/library/Meshes.h"
#include "core/trace/BakeGeometry.h"
#include "core/trace/RayScene.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <fstream>
#include <malloc.h>
#include <string>

using namespace patina;

namespace {

struct MemoryCase {
    const char* name;
    int segments, sides; // of a torus knot
    int order, samples;
};
constexpr MemoryCase kMemoryCases[] = {{"100k vertices, 5 bands, 1024 rays", 3124, 32, 5, 1024},
                                       {"1M vertices, 4 bands, 256 rays", 10'000, 100, 4, 256},
                                       {"5M triangles, 4 bands, 32 rays", 16'667, 150, 4, 32},
                                       {"10M triangles, 3 bands, 16 rays", 33'334, 150, 3, 16}};

// "VmHWM:   12345 kB" of this process, MiB.
double statusMiB(const std::string& key) {
    std::ifstream stream("/proc/self/status");
    for (std::string word; stream >> word;)
        if (double kibibytes = 0.0; word == key && stream >> kibibytes)
            return kibibytes / 1024.0;
    return 0.0;
}

class Peak {
  public:
    Peak() {
        malloc_trim(0);
        std::ofstream("/proc/self/clear_refs") << 5; // the peak starts anew
        m_before = statusMiB("VmRSS:");
    }
    [[nodiscard]] double mebibytes() const { return statusMiB("VmHWM:") - m_before; }

  private:
    double m_before;
};

void peakMemory(benchmark::State& state) {
    const MemoryCase& c = kMemoryCases[state.range(0)];
    Document document;
    BakeInputs inputs;
    {
        Mesh mesh = library::makeTorusKnot(c.segments, c.sides);
        (void)sanitizeMesh(mesh);
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = 1;
        instance.name = "knot";
        instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
        inputs.meshes.push_back({1, 1, instance.mesh, glm::mat4(1.0f), false, {}});
    }
    const double vertices = double(document.meshes[0].mesh->vertexCount());
    double hierarchy = 0.0;
    {
        const BakeGeometry geometry = *makeBakeGeometry(inputs, {});
        const Result<RayScene> scene = RayScene::build(geometry, {}, 0, vertices * c.samples);
        hierarchy = double(scene->memoryBytes()) / double(1 << 20);
    }
    PrtSettings settings;
    settings.order = c.order;
    settings.samples = c.samples;
    settings.fitted = false;
    WorkerClient worker;
    worker.warmUp(WorkerKind::Image);
    double bake = 0.0, file = 0.0;
    for (auto _ : state) {
        TileSink sink;
        const Peak ofBake;
        const Result<BakeArtifact> artifact = bakePrtVertex(inputs, settings, sink, {});
        bake = ofBake.mebibytes();
        if (!artifact) {
            state.SkipWithError(artifact.error().message.c_str());
            return;
        }
        const Peak ofFile;
        const Result<Bytes> bytes = encodeBake(worker, *artifact, document, {});
        file = ofFile.mebibytes();
        if (!bytes) {
            state.SkipWithError(bytes.error().message.c_str());
            return;
        }
    }
    const double coefficients = vertices * c.order * c.order * sizeof(float) / double(1 << 20);
    state.counters["coefficients MiB"] = coefficients;
    state.counters["hierarchy MiB"] = hierarchy;
    state.counters["bake MiB"] = bake;
    state.counters["of both"] = bake / (coefficients + hierarchy); // at most 1.25
    state.counters["file MiB"] = file;                             // on top of the coefficients
    state.SetLabel(c.name);
}

} // namespace

BENCHMARK(peakMemory)->DenseRange(0, 3)->ArgName("case")->Iterations(1)->Unit(benchmark::kSecond);

#include "tests/core/worker/MutantRun.h"

#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/material/Material.h"
#include "tests/core/worker/ModelFiles.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

namespace patina::test {

namespace {

std::string mutate(const std::vector<std::string>& seeds, std::mt19937_64& random) {
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
    std::string bytes = seeds[below(seeds.size())];
    switch (below(5)) {
    case 0: // cut short
        bytes.resize(below(bytes.size()));
        break;
    case 1: // flipped bits
        for (std::size_t i = 0, n = 1 + below(16); i < n && !bytes.empty(); ++i)
            bytes[below(bytes.size())] ^= static_cast<char>(1 << below(8));
        break;
    case 2: { // spliced with another file of the format or itself
        const std::string& other = seeds[below(seeds.size())];
        const std::size_t from = below(other.size());
        bytes = bytes.substr(0, below(bytes.size())) + other.substr(from);
        break;
    }
    case 3: { // a number of the kind that sizes are made of
        static constexpr std::uint32_t kNumbers[] = {0,          1,      0x7fffffff, 0x80000000,
                                                     0xffffffff, 0xffff, 0x7fc00000};
        const std::uint32_t value = kNumbers[below(std::size(kNumbers))];
        const std::size_t at = below(bytes.size());
        for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
            bytes[at + i] = static_cast<char>(value >> (8 * i));
        break;
    }
    default: { // a piece removed, repeated or replaced by noise
        const std::size_t at = below(bytes.size());
        const std::size_t length = std::min(bytes.size() - at, 1 + below(64));
        const std::size_t how = below(3);
        if (how == 0)
            bytes.erase(at, length);
        else if (how == 1)
            bytes.insert(at, bytes.substr(at, length));
        else
            for (std::size_t i = 0; i < length; ++i)
                bytes[at + i] = static_cast<char>(random());
        break;
    }
    }
    return bytes;
}

bool keepsPromises(const ImportedModel& model) {
    for (const auto& mesh : model.meshes) {
        const std::size_t n = mesh->vertexCount();
        if (mesh->normals.size() != n || mesh->uvs.size() != n || mesh->tangents.size() != n ||
            mesh->indices.empty())
            return false;
        for (const std::uint32_t index : mesh->indices)
            if (index >= n)
                return false;
        for (std::size_t i = 0; i < n; ++i)
            for (int c = 0; c < 3; ++c)
                if (!std::isfinite(mesh->positions[i][c]) || !std::isfinite(mesh->normals[i][c]) ||
                    !std::isfinite(mesh->tangents[i][c]) ||
                    (c < 2 && !std::isfinite(mesh->uvs[i][c])))
                    return false;
    }
    for (const ImportedInstance& instance : model.instances) {
        if (static_cast<std::size_t>(instance.mesh) >= model.meshes.size() ||
            static_cast<std::size_t>(instance.material) >= model.materials.size())
            return false;
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(instance.transform[i / 4][i % 4]))
                return false;
    }
    return !model.instances.empty();
}

bool keepsPromises(const LoadedImage& loaded) {
    const Image& image = loaded.image();
    if (image.empty())
        return false;
    if (image.type() == PixelType::F32)
        for (const float sample : image.f32())
            if (!(sample >= 0.0f) || std::isinf(sample))
                return false;
    return true;
}

template <class T>
void count(const Result<T>& result, MutantTally& tally) {
    if (result.ok()) {
        ++tally.loaded;
        if (!keepsPromises(*result))
            ++tally.broken;
        return;
    }
    const std::string text = result.error().text();
    if (text.find("took longer than") != std::string::npos)
        ++tally.timedOut;
    else if (text.find("decoder crash") != std::string::npos ||
             text.find("without an answer") != std::string::npos)
        ++tally.died;
    else
        ++tally.rejected;
    if (result.error().message.empty() || result.error().kind == ErrorKind::Internal)
        ++tally.broken;
}

} // namespace

MutantTally runMutants(WorkerClient& worker, const WorkerLimits& limits, const std::string& format,
                       const std::vector<std::string>& seeds, int number, std::uint64_t seed) {
    worker.setLimits(limits);
    const TemporaryFolder folder;
    folder.write("seed.mtl", std::string_view(kObjMaterials));
    const bool model = std::find(modelExtensions().begin(), modelExtensions().end(),
                                 "." + format) != modelExtensions().end();
    MutantTally tally;
    for (int i = 0; i < number; ++i) {
        std::seed_seq sequence{seed, static_cast<std::uint64_t>(i)};
        std::mt19937_64 random(sequence);
        const auto file = folder.write("mutant." + format, mutate(seeds, random));
        const auto begin = std::chrono::steady_clock::now();
        if (model)
            count(importModel(worker, file), tally);
        else
            count(loadImage(worker, file), tally);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        tally.slowestSeconds = std::max(tally.slowestSeconds, seconds);
        // The limit is the request's; writing and repairing come on top.
        constexpr double kSlack = 5.0;
        if (seconds > limits.wallSeconds + kSlack)
            ++tally.overdue;
    }
    return tally;
}

} // namespace patina::test

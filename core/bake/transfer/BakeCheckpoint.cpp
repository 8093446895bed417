#include "core/bake/transfer/BakeCheckpoint.h"

#include "core/base/Check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina {
namespace {

namespace fs = std::filesystem;

// The description is the manifest as JSON; the arrays follow one after another as in PassState,
// each with the points of the shard's ranges.
constexpr StateFormat kBakeState = {
    {'P', 'a', 't', 'i', 'n', 'a', 'B', 'k'},
    2, // also counts changes of how bakes trace and sample
    "this is no part and no checkpoint of a bake; make parts with patina bake … --shard K/N",
    "bake it anew"};

struct KindName {
    BakeKind kind;
    const char* name;
};
constexpr KindName kKinds[] = {{BakeKind::AoTexel, "ao-texel"},
                               {BakeKind::AoVertex, "ao-vertex"},
                               {BakeKind::PrtVertex, "prt-vertex"},
                               {BakeKind::PrtTexel, "prt-texel"},
                               {BakeKind::LightMap, "light-map"}};

std::string hashText(const Hash& hash) {
    return hash == Hash{} ? std::string() : hash.hex();
}

Hash hashFromText(const std::string& text) {
    if (text.size() != 32)
        return {};
    return {std::stoull(text.substr(0, 16), nullptr, 16),
            std::stoull(text.substr(16), nullptr, 16)};
}

std::string manifestText(const BakeManifest& m) {
    nlohmann::ordered_json json;
    for (const KindName& kind : kKinds)
        if (kind.kind == m.kind)
            json["kind"] = kind.name;
    json["settings"] = m.settings;
    json["inputs"] = hashText(m.inputs);
    json["albedo"] = hashText(m.albedo);
    if (m.kind == BakeKind::LightMap) {
        json["light"] = hashText(m.light);
        json["environment"] = m.environment;
        json["environmentLayout"] = m.environmentLayout;
    }
    json["scene"] = m.scene;
    json["sets"] = m.sets;
    json["storage"] = storageName(m.storage.storage);
    json["bits"] = m.storage.bits;
    json["shard"] = {m.shard.index, m.shard.count};
    json["points"] = m.points;
    json["ranges"] = m.ranges;
    json["complete"] = m.complete;
    json["samplesDone"] = m.samplesDone;
    json["done"] = m.done;
    // Names of files may be no UTF-8; a damaged one is then not found, and said so.
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<BakeManifest> manifestFromText(const std::string& text) {
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        BakeManifest m;
        bool known = false;
        for (const KindName& kind : kKinds) {
            if (json.at("kind") != kind.name)
                continue;
            m.kind = kind.kind;
            known = true;
        }
        m.settings = json.at("settings").get<std::map<std::string, std::string>>();
        m.inputs = hashFromText(json.at("inputs").get<std::string>());
        m.albedo = hashFromText(json.at("albedo").get<std::string>());
        if (m.kind == BakeKind::LightMap) {
            m.light = hashFromText(json.at("light").get<std::string>());
            m.environment = json.at("environment").get<std::string>();
            m.environmentLayout = json.at("environmentLayout").get<std::string>();
        }
        m.scene = json.at("scene").get<std::string>();
        m.sets = json.at("sets").get<std::vector<std::string>>();
        const auto storage = storageNamed(json.at("storage").get<std::string>());
        m.storage = {storage.value_or(BakeStorage::Float), json.at("bits").get<int>()};
        m.shard = {json.at("shard").at(0).get<int>(), json.at("shard").at(1).get<int>()};
        m.points = json.at("points").get<std::uint64_t>();
        m.ranges = json.at("ranges").get<std::uint64_t>();
        m.complete = json.at("complete").get<bool>();
        m.samplesDone = json.at("samplesDone").get<int>();
        m.done = json.at("done").get<double>();
        const bool quantised = storage == BakeStorage::Quantised;
        if (!known || !storage || m.shard.index < 0 || m.shard.index >= m.shard.count ||
            m.samplesDone < 0 || (quantised && !holdsTransfer(m.kind)) ||
            m.storage.bits < kMinStorageBits || m.storage.bits > kMaxStorageBits)
            return std::nullopt;
        return m;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

// The ranges of a shard, neighbours joined: all of them are one.
std::vector<PointRange> heldRanges(std::span<const PointRange> ranges, const PassShard& shard) {
    std::vector<PointRange> held;
    for (std::size_t r = 0; r < ranges.size(); ++r) {
        if (!shard.holds(r))
            continue;
        if (!held.empty() && held.back().first + held.back().count == ranges[r].first)
            held.back().count += ranges[r].count;
        else
            held.push_back(ranges[r]);
    }
    return held;
}

std::size_t pointCount(std::span<const PointRange> ranges) {
    std::size_t count = 0;
    for (const PointRange& range : ranges)
        count += range.count;
    return count;
}

// Calls f(array, elements per point) for each array of a state.
template <class State, class F>
void forArrays(State& state, std::size_t stride, const F& f) {
    f(state.values, stride);
    f(state.hiddenSky, std::size_t{1});
    f(state.error, std::size_t{1});
    f(state.passes, std::size_t{1});
    f(state.wanted, std::size_t{1});
}

Result<BakeManifest> openManifest(StateFileReader& reader) {
    const Result<std::string> text = reader.open();
    if (!text)
        return text.error();
    std::optional<BakeManifest> manifest = manifestFromText(*text);
    if (!manifest)
        return reader.damaged("its description makes no sense");
    if (Result<void> plausible = reader.check(manifest->settings); !plausible)
        return plausible.error();
    return std::move(manifest).value();
}

} // namespace

std::optional<std::string> whyDifferent(const BakeManifest& there, const BakeManifest& here) {
    if (there.kind != here.kind)
        return "the kind of bake";
    if (auto setting = differingSetting(there.settings, here.settings))
        return setting;
    if (there.inputs != here.inputs || there.points != here.points || there.ranges != here.ranges)
        return there.scene == here.scene
                   ? fmt::format("the geometry of {}, which was changed", here.scene)
                   : fmt::format("the scene ({} there, {} here)", there.scene, here.scene);
    if (there.albedo != here.albedo)
        return std::string("the albedo of the materials");
    if (there.light != here.light)
        return std::string("the light: the environment, the lights or the materials");
    if (!(there.storage == here.storage))
        return std::string("how the values are stored");
    return std::nullopt;
}

Result<void> writeBakeCheckpoint(const fs::path& file, const BakeManifest& manifest,
                                 const PassState& state, std::span<const PointRange> ranges,
                                 StateFileName name) {
    const std::vector<PointRange> held = heldRanges(ranges, manifest.shard);
    const std::size_t stride = state.values.size() / std::max<std::size_t>(state.passes.size(), 1);
    std::vector<std::span<const std::byte>> pieces;
    forArrays(state, stride, [&](const auto& array, std::size_t perPoint) {
        if (array.empty())
            return;
        for (const PointRange& range : held)
            pieces.push_back(std::as_bytes(
                std::span(array).subspan(range.first * perPoint, range.count * perPoint)));
    });
    return writeStateFile(file, kBakeState, manifestText(manifest), pieces, name);
}

bool looksLikeCheckpoint(const fs::path& file) {
    return isStateFile(file, kBakeState);
}

Result<BakeManifest> readBakeManifest(const fs::path& file) {
    StateFileReader reader(file, kBakeState);
    return openManifest(reader);
}

Result<void> readBakeState(const fs::path& file, std::span<const PointRange> ranges, int stride,
                           PassState& state) {
    StateFileReader reader(file, kBakeState);
    const Result<BakeManifest> manifest = openManifest(reader);
    if (!manifest)
        return manifest.error();
    const std::size_t points = pointCount(ranges);
    if (manifest->points != points || manifest->ranges != ranges.size())
        return reader.damaged("it holds points of another scene");
    const bool transfer = holdsTransfer(manifest->kind);
    // The sums of a light map tell their error themselves, and no pass skips any of its texels.
    const bool sums = manifest->kind == BakeKind::LightMap;
    const std::vector<PointRange> held = heldRanges(ranges, manifest->shard);
    const auto perPoint = static_cast<std::size_t>(stride);
    const std::size_t bytesPerPoint =
        sums ? perPoint * sizeof(float) + sizeof(std::uint8_t)
             : (perPoint + (transfer ? 2 : 1)) * sizeof(float) + 2 * sizeof(std::uint8_t);
    if (Result<void> fits = reader.expect(pointCount(held) * bytesPerPoint); !fits)
        return fits;

    if (state.passes.empty()) {
        state.values.resize(points * perPoint);
        if (transfer)
            state.hiddenSky.resize(points);
        state.passes.resize(points);
        if (!sums) {
            state.error.resize(points);
            state.wanted.resize(points);
        }
    }
    CHECK_EQ(state.values.size(), points * perPoint);
    forArrays(state, perPoint, [&](auto& array, std::size_t each) {
        if (array.empty())
            return;
        for (const PointRange& range : held)
            reader.read(std::as_writable_bytes(
                std::span(array).subspan(range.first * each, range.count * each)));
    });
    if (Result<void> whole = reader.finish(); !whole)
        return whole;
    state.samplesDone = manifest->samplesDone;
    return {};
}

Checkpointer::Checkpointer(fs::path file, BakeManifest manifest, std::span<const PointRange> ranges,
                           Warn warn)
    : m_file(std::move(file))
    , m_manifest(std::move(manifest))
    , m_ranges(ranges)
    , m_warn(std::move(warn)) {}

bool Checkpointer::write(const PassState& state, bool complete, double done) {
    m_manifest.samplesDone = state.samplesDone;
    m_manifest.complete = complete;
    m_manifest.done = done;
    const Result<void> result = writeBakeCheckpoint(m_file, m_manifest, state, m_ranges);
    if (!result && !m_warned && m_warn)
        m_warn(result.error());
    m_warned = m_warned || !result;
    return result.ok();
}

} // namespace patina

#include "core/bake/transfer/BakeCheckpoint.h"

#include "core/base/AtomicFile.h"
#include "core/base/Check.h"
#include "core/base/FileDescriptor.h"
#include "core/base/InputFile.h"
#include "core/base/OwnFile.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

// Layout, least significant byte first: Prologue, the manifest as JSON, its hash, the arrays one
// after another as in PassState, their hash. Arrays hold the points of the shard's ranges.
constexpr std::array<char, 8> kMagic = {'P', 'a', 't', 'i', 'n', 'a', 'B', 'k'};
constexpr std::uint32_t kVersion = 2; // also counts changes of how bakes trace and sample
constexpr std::uint32_t kMaxManifest = 1u << 20;

struct Prologue {
    std::array<char, 8> magic = kMagic;
    std::uint32_t version = kVersion;
    std::uint32_t manifestBytes = 0;
};
static_assert(sizeof(Prologue) == 16 && std::endian::native == std::endian::little);

struct KindName {
    BakeKind kind;
    const char* name;
};
constexpr KindName kKinds[] = {{BakeKind::AoTexel, "ao-texel"},
                               {BakeKind::AoVertex, "ao-vertex"},
                               {BakeKind::PrtVertex, "prt-vertex"},
                               {BakeKind::PrtTexel, "prt-texel"}};

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
        if (!known || !storage || m.shard.index < 0 || m.shard.index >= m.shard.count ||
            m.samplesDone < 0)
            return std::nullopt;
        return m;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

Hash hashOf(std::string_view text) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())));
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

class Reader {
  public:
    explicit Reader(const fs::path& file)
        : m_file(file) {}

    [[nodiscard]] Error damaged(const std::string& what) const {
        return {
            ErrorKind::InputBroken,
            fmt::format("the checkpoint or part is damaged ({}); remove it and bake it anew", what),
            m_file,
            {}};
    }

    Result<BakeManifest> open() {
        Result<RegularFile> file = openRegularFile(m_file);
        if (!file)
            return file.error();
        m_descriptor = std::move(file->fd);
        m_left = file->size;
        Prologue prologue;
        if (!read(&prologue, sizeof prologue) || prologue.magic != kMagic)
            return Error{ErrorKind::InputBroken,
                         "this is no part and no checkpoint of a bake; make parts with patina bake "
                         "… --shard K/N",
                         m_file,
                         {}};
        if (prologue.version != kVersion)
            return Error{ErrorKind::InputBroken,
                         fmt::format("it was written by another version of Patina (format {}, this "
                                     "is {}); bake it anew",
                                     prologue.version, kVersion),
                         m_file,
                         {}};
        if (prologue.manifestBytes > kMaxManifest || prologue.manifestBytes > m_left)
            return damaged("its end is missing");
        std::string text(prologue.manifestBytes, '\0');
        Hash hash;
        if (!read(text.data(), text.size()) || !read(&hash, sizeof hash))
            return damaged("its end is missing");
        if (hash != hashOf(text))
            return damaged("its description was changed");
        std::optional<BakeManifest> manifest = manifestFromText(text);
        if (!manifest)
            return damaged("its description makes no sense");
        return std::move(manifest).value();
    }

    [[nodiscard]] bool read(void* to, std::size_t size) {
        auto* bytes = static_cast<std::byte*>(to);
        while (size > 0) {
            const ssize_t count = ::read(m_descriptor.get(), bytes, size);
            if (count < 0 && errno == EINTR)
                continue;
            if (count <= 0)
                return false;
            bytes += count;
            size -= static_cast<std::size_t>(count);
            m_left -= std::min(m_left, static_cast<std::uint64_t>(count));
        }
        return true;
    }
    [[nodiscard]] std::uint64_t left() const { return m_left; }

  private:
    const fs::path& m_file;
    FileDescriptor m_descriptor;
    std::uint64_t m_left = 0;
};

} // namespace

std::optional<std::string> whyDifferent(const BakeManifest& there, const BakeManifest& here) {
    if (there.kind != here.kind)
        return "the kind of bake";
    for (const auto& [name, value] : here.settings) {
        const auto other = there.settings.find(name);
        if (other == there.settings.end() || other->second != value)
            return fmt::format("{} ({} there, {} here)", name,
                               other == there.settings.end() ? "none" : other->second, value);
    }
    for (const auto& [name, value] : there.settings)
        if (!here.settings.contains(name))
            return fmt::format("{} ({} there, none here)", name, value);
    if (there.inputs != here.inputs || there.points != here.points || there.ranges != here.ranges)
        return there.scene == here.scene
                   ? fmt::format("the geometry of {}, which was changed", here.scene)
                   : fmt::format("the scene ({} there, {} here)", there.scene, here.scene);
    if (there.albedo != here.albedo)
        return std::string("the albedo of the materials");
    if (!(there.storage == here.storage))
        return std::string("how the values are stored");
    return std::nullopt;
}

Result<void> writeBakeCheckpoint(const fs::path& file, const BakeManifest& manifest,
                                 const PassState& state, std::span<const PointRange> ranges,
                                 CheckpointName name) {
    const std::string text = manifestText(manifest);
    Prologue prologue;
    prologue.manifestBytes = static_cast<std::uint32_t>(text.size());
    const Hash textHash = hashOf(text);

    const std::vector<PointRange> held = heldRanges(ranges, manifest.shard);
    const std::size_t stride = state.values.size() / std::max<std::size_t>(state.passes.size(), 1);
    std::vector<std::span<const std::byte>> pieces = {std::as_bytes(std::span(&prologue, 1)),
                                                      std::as_bytes(std::span(text)),
                                                      std::as_bytes(std::span(&textHash, 1))};
    Hasher hasher;
    forArrays(state, stride, [&](const auto& array, std::size_t perPoint) {
        if (array.empty())
            return;
        for (const PointRange& range : held) {
            pieces.push_back(std::as_bytes(
                std::span(array).subspan(range.first * perPoint, range.count * perPoint)));
            hasher.bytes(pieces.back());
        }
    });
    const Hash hash = hasher.finish();
    pieces.push_back(std::as_bytes(std::span(&hash, 1)));
    return name == CheckpointName::OfUser ? writePiecesAtomically(file, pieces)
                                          : writeOwnPieces(file, pieces);
}

bool looksLikeCheckpoint(const fs::path& file) {
    const Result<RegularFile> opened = openRegularFile(file);
    std::array<char, kMagic.size()> magic{};
    return opened.ok() &&
           ::read(opened->fd.get(), magic.data(), magic.size()) ==
               static_cast<ssize_t>(magic.size()) &&
           magic == kMagic;
}

Result<BakeManifest> readBakeManifest(const fs::path& file) {
    return Reader(file).open();
}

Result<void> readBakeState(const fs::path& file, std::span<const PointRange> ranges, int stride,
                           PassState& state) {
    Reader reader(file);
    const Result<BakeManifest> manifest = reader.open();
    if (!manifest)
        return manifest.error();
    const std::size_t points = pointCount(ranges);
    if (manifest->points != points || manifest->ranges != ranges.size())
        return reader.damaged("it holds points of another scene");
    const bool transfer = holdsTransfer(manifest->kind);
    const std::vector<PointRange> held = heldRanges(ranges, manifest->shard);
    const auto perPoint = static_cast<std::size_t>(stride);
    const std::size_t bytesPerPoint =
        (perPoint + (transfer ? 2 : 1)) * sizeof(float) + 2 * sizeof(std::uint8_t);
    if (reader.left() != pointCount(held) * bytesPerPoint + sizeof(Hash))
        return reader.damaged(reader.left() < pointCount(held) * bytesPerPoint + sizeof(Hash)
                                  ? "its end is missing"
                                  : "something follows its end");

    if (state.passes.empty()) {
        state.values.resize(points * perPoint);
        if (transfer)
            state.hiddenSky.resize(points);
        state.error.resize(points);
        state.passes.resize(points);
        state.wanted.resize(points);
    }
    CHECK_EQ(state.values.size(), points * perPoint);
    Hasher hasher;
    bool ended = false;
    forArrays(state, perPoint, [&](auto& array, std::size_t each) {
        if (array.empty())
            return;
        for (const PointRange& range : held) {
            const auto piece = std::span(array).subspan(range.first * each, range.count * each);
            ended = ended || !reader.read(piece.data(), piece.size_bytes());
            hasher.bytes(std::as_bytes(piece));
        }
    });
    Hash hash;
    if (ended || !reader.read(&hash, sizeof hash))
        return reader.damaged("its end is missing");
    if (hash != hasher.finish())
        return reader.damaged("its values were changed");
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

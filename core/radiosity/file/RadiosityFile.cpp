#include "core/radiosity/file/RadiosityFile.h"

#include "core/trace/path/TraceScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::radiosity {
namespace {

namespace fs = std::filesystem;

constexpr StateFormat kRadiosityState = {
    {'P', 'a', 't', 'i', 'n', 'a', 'R', 'd'},
    1, // also counts changes of how elements are divided, lit and sampled
    "this is no part and no checkpoint of radiosity; make parts with patina bake radiosity … "
    "--shard K/N",
    "bake it anew"};

// What is not believed before the file is as large.
constexpr std::uint64_t kMostElements = 50'000'000, kMostShares = std::uint64_t{1} << 40;
constexpr std::uint64_t kMostSteps = std::uint64_t{1} << 32;
constexpr int kMostShards = 1'000'000;
constexpr std::size_t kMostDivisions = 64;

// Of an element of the shard.
struct ElementRecord {
    glm::dvec3 direct{0.0}; // W/m²
    std::uint32_t shares = 0;
    float absorbed = 0.0f, escaped = 0.0f;
    std::uint32_t rays = 0;
    std::uint32_t found = 0; // kHasLight | kHasRow
    std::uint32_t none = 0;
};
constexpr std::uint32_t kHasLight = 1, kHasRow = 2;
static_assert(sizeof(ElementRecord) == 48 && std::is_trivially_copyable_v<ElementRecord> &&
              sizeof(FactorRow::Share) == 8 && sizeof(SolveStep) == 16 && sizeof(glm::dvec3) == 24);

// Throws what is no hash, as nlohmann does what is no number.
Hash radiosityHash(const nlohmann::json& json) {
    const auto text = json.get<std::string>();
    if (text.size() != 32 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
        throw std::invalid_argument(text);
    return {std::stoull(text.substr(0, 16), nullptr, 16),
            std::stoull(text.substr(16), nullptr, 16)};
}

std::uint64_t countOf(const nlohmann::json& json, std::uint64_t most) {
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > most)
        throw std::out_of_range("count");
    return json.get<std::uint64_t>();
}

std::string radiosityManifestText(const RadiosityManifest& m) {
    nlohmann::ordered_json json;
    json["settings"] = m.settings;
    json["options"] = m.options;
    json["geometry"] = m.inputs.geometry.hex();
    json["materials"] = m.inputs.materials.hex();
    json["lights"] = m.inputs.lights.hex();
    json["environment"] = m.inputs.environment.hex();
    json["elements"] = m.elements.hex();
    json["scene"] = m.scene;
    json["sets"] = m.sets;
    json["shard"] = {m.shard.index, m.shard.count};
    json["complete"] = m.complete;
    json["elementCount"] = m.elementCount;
    json["lit"] = m.lit;
    json["rows"] = m.rows;
    json["shares"] = m.shares;
    json["divided"] = m.divided;
    json["divisionDone"] = m.divisionDone;
    json["steps"] = m.steps;
    json["iterations"] = m.iterations;
    json["residual"] = m.residual;
    json["ended"] = m.ended;
    json["shootAgain"] = m.shootAgain;
    // Names of files may be no UTF-8; a damaged one is then not found, and said so.
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<RadiosityManifest> radiosityManifestFromText(const std::string& text) {
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        RadiosityManifest m;
        m.settings = json.at("settings").get<StateSettings>();
        m.options = json.at("options").get<StateSettings>();
        m.inputs = {radiosityHash(json.at("geometry")), radiosityHash(json.at("materials")),
                    radiosityHash(json.at("lights")), radiosityHash(json.at("environment"))};
        m.elements = radiosityHash(json.at("elements"));
        m.scene = json.at("scene").get<std::string>();
        m.sets = json.at("sets").get<std::vector<std::string>>();
        m.shard = {static_cast<int>(countOf(json.at("shard").at(0), kMostShards)),
                   static_cast<int>(countOf(json.at("shard").at(1), kMostShards))};
        m.complete = json.at("complete").get<bool>();
        m.elementCount = countOf(json.at("elementCount"), kMostElements);
        m.lit = countOf(json.at("lit"), kMostElements);
        m.rows = countOf(json.at("rows"), kMostElements);
        m.shares = countOf(json.at("shares"), kMostShares);
        for (const nlohmann::json& count : json.at("divided"))
            m.divided.push_back(countOf(count, kMostElements));
        m.divisionDone = json.at("divisionDone").get<bool>();
        m.steps = countOf(json.at("steps"), kMostSteps);
        m.iterations = countOf(json.at("iterations"), ~std::uint64_t{0});
        m.residual = json.at("residual").get<double>();
        m.ended = json.at("ended").get<bool>();
        m.shootAgain = json.value("shootAgain", false); // older files have none
        if (m.shard.index >= m.shard.count || m.divided.size() > kMostDivisions)
            return std::nullopt;
        return m;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

Result<RadiosityManifest> openRadiosity(StateFileReader& reader) {
    const Result<std::string> text = reader.open();
    if (!text)
        return text.error();
    std::optional<RadiosityManifest> m = radiosityManifestFromText(*text);
    if (!m)
        return reader.damaged("its description makes no sense");
    for (const StateSettings* settings : {&m->settings, &m->options})
        if (Result<void> plausible = reader.check(*settings); !plausible)
            return plausible.error();
    std::uint64_t bytes = m->shard.held(m->elementCount) * sizeof(ElementRecord) +
                          m->shares * sizeof(FactorRow::Share);
    for (const std::uint64_t count : m->divided)
        bytes += count * sizeof(std::uint32_t);
    if (m->steps > 0)
        bytes += (2 * m->elementCount + 2) * sizeof(glm::dvec3) + m->steps * sizeof(SolveStep);
    if (Result<void> fits = reader.expect(bytes); !fits)
        return fits.error();
    return *std::move(m);
}

std::vector<std::vector<std::uint32_t>> divisionsOf(StateFileReader& reader,
                                                    const RadiosityManifest& manifest) {
    std::vector<std::vector<std::uint32_t>> divisions;
    for (const std::uint64_t count : manifest.divided) {
        divisions.emplace_back(count);
        reader.read(std::as_writable_bytes(std::span(divisions.back())));
    }
    return divisions;
}

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Light and shares are never negative.
bool isPlausible(const ElementRecord& record) {
    return isFinite(record.direct) && record.direct.x >= 0.0 && record.direct.y >= 0.0 &&
           record.direct.z >= 0.0 && record.absorbed >= 0.0f && std::isfinite(record.absorbed) &&
           record.escaped >= 0.0f && std::isfinite(record.escaped) &&
           record.found <= (kHasLight | kHasRow) &&
           ((record.found & kHasRow) != 0 || record.shares == 0);
}

bool isPlausible(const FactorRow& row, std::uint64_t elements) {
    for (std::size_t i = 0; i < row.shares.size(); ++i) {
        const FactorRow::Share& share = row.shares[i];
        if (share.element >= elements || !(share.factor >= 0.0f) || !std::isfinite(share.factor) ||
            (i > 0 && share.element <= row.shares[i - 1].element))
            return false;
    }
    return true;
}

// The solver's part; false where it makes no sense.
bool readSolver(StateFileReader& reader, const RadiosityManifest& manifest, SolverState& solver) {
    if (manifest.steps == 0)
        return !manifest.ended && !manifest.shootAgain;
    solver.radiosity.resize(manifest.elementCount);
    solver.irradiance.resize(manifest.elementCount);
    solver.steps.resize(manifest.steps);
    std::array<glm::dvec3, 2> sums{};
    reader.read(std::as_writable_bytes(std::span(solver.radiosity)));
    reader.read(std::as_writable_bytes(std::span(solver.irradiance)));
    reader.read(std::as_writable_bytes(std::span(sums)));
    reader.read(std::as_writable_bytes(std::span(solver.steps)));
    solver.unshotPower = sums[0];
    solver.lost = sums[1];
    solver.ended = manifest.ended;
    solver.shootAgain = manifest.shootAgain;
    return std::ranges::all_of(solver.radiosity, isFinite) &&
           std::ranges::all_of(solver.irradiance, isFinite) &&
           std::ranges::all_of(sums, isFinite) &&
           std::ranges::is_sorted(solver.steps, {}, &SolveStep::iterations) &&
           std::ranges::all_of(
               solver.steps, [](const SolveStep& step) { return std::isfinite(step.residual); }) &&
           solver.steps.back().iterations == manifest.iterations;
}

void addElements(Hasher& hasher, const ElementMesh& elements) {
    hasher.array(elements.areas());
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        hasher.value(elements.exposed(e));
}

} // namespace

Hash hashElements(const ElementMesh& elements) {
    Hasher hasher;
    addElements(hasher, elements);
    return hasher.finish();
}

Hash hashElements(const TraceScene& scene, const ElementMesh& elements) {
    Hasher hasher;
    addElements(hasher, elements);
    // Rays to a light follow from its number.
    for (std::uint32_t l = 0; l < scene.lights().size(); ++l)
        hasher.value(static_cast<std::uint64_t>(scene.lights().id(l)));
    return hasher.finish();
}

std::optional<std::string> whyDifferent(const RadiosityManifest& there,
                                        const RadiosityManifest& here) {
    if (auto setting = differingSetting(there.settings, here.settings))
        return setting;
    if (auto inputs = differingInputs(there.inputs, here.inputs))
        return there.scene == here.scene
                   ? fmt::format("{} of {}, which changed", *inputs, here.scene)
                   : fmt::format("{} ({} there, {} here)", *inputs, there.scene, here.scene);
    if (there.elements != Hash{} && here.elements != Hash{} &&
        (there.elements != here.elements || there.elementCount != here.elementCount))
        return fmt::format("the elements that the scene is divided into ({} there, {} here), as "
                           "another processor or another version may round them",
                           there.elementCount, here.elementCount);
    return std::nullopt;
}

Result<void> writeRadiosity(const fs::path& file, RadiosityManifest manifest,
                            const SolveState& state, const SolverView& solver, StateFileName name) {
    // What is found from here on is left out.
    const std::size_t elements = state.light.size();
    std::vector<ElementRecord> records;
    records.reserve(manifest.shard.held(elements));
    std::vector<std::span<const std::byte>> rows;
    manifest.lit = manifest.rows = manifest.shares = 0;
    for (std::uint32_t e = 0; e < elements; ++e) {
        if (!manifest.shard.holds(e))
            continue;
        ElementRecord& record = records.emplace_back();
        if (state.light.has(e)) {
            record.direct = state.light.irradiance(e);
            record.found |= kHasLight;
            ++manifest.lit;
        }
        if (e < state.rows.size() && state.rows.has(e)) { // there may be less patches than elements
            const FactorRow& row = state.rows.whole(e);
            record.shares = static_cast<std::uint32_t>(row.shares.size());
            record.absorbed = row.absorbed;
            record.escaped = row.escaped;
            record.rays = row.rays;
            record.found |= kHasRow;
            ++manifest.rows;
            manifest.shares += row.shares.size();
            rows.push_back(std::as_bytes(std::span(row.shares)));
        }
    }
    manifest.elementCount = elements;
    manifest.complete =
        manifest.lit == records.size() && manifest.rows == manifest.shard.held(state.rows.size());
    manifest.divided.clear();
    std::vector<std::span<const std::byte>> pieces;
    for (const std::vector<std::uint32_t>& round : state.divisions) {
        manifest.divided.push_back(round.size());
        pieces.push_back(std::as_bytes(std::span(round)));
    }
    manifest.divisionDone = state.divided;
    pieces.push_back(std::as_bytes(std::span(records)));
    pieces.insert(pieces.end(), rows.begin(), rows.end());
    manifest.steps = solver.steps.size();
    manifest.ended = solver.ended;
    manifest.shootAgain = solver.shootAgain;
    manifest.iterations = 0;
    manifest.residual = 0.0;
    const std::array sums{solver.unshotPower, solver.lost};
    if (manifest.steps > 0) {
        manifest.iterations = solver.steps.back().iterations;
        manifest.residual = solver.steps.back().residual;
        pieces.push_back(std::as_bytes(solver.radiosity));
        pieces.push_back(std::as_bytes(solver.irradiance));
        pieces.push_back(std::as_bytes(std::span(sums)));
        pieces.push_back(std::as_bytes(solver.steps));
    }
    return writeStateFile(file, kRadiosityState, radiosityManifestText(manifest), pieces, name);
}

bool looksLikeRadiosity(const fs::path& file) {
    return isStateFile(file, kRadiosityState);
}

Result<RadiosityManifest> readRadiosityManifest(const fs::path& file) {
    StateFileReader reader(file, kRadiosityState);
    return openRadiosity(reader);
}

Result<std::vector<std::vector<std::uint32_t>>> readDivisions(const fs::path& file) {
    StateFileReader reader(file, kRadiosityState);
    const Result<RadiosityManifest> manifest = openRadiosity(reader);
    if (!manifest)
        return manifest.error();
    return divisionsOf(reader, *manifest);
}

Result<void> readRadiosity(const fs::path& file, std::size_t maxRowBytes, SolveState& state) {
    StateFileReader reader(file, kRadiosityState);
    const Result<RadiosityManifest> manifest = openRadiosity(reader);
    if (!manifest)
        return manifest.error();
    if (manifest->elementCount != state.light.size())
        return reader.damaged("it is of another division");
    state.divisions = divisionsOf(reader, *manifest);
    state.divided = manifest->divisionDone;
    std::vector<ElementRecord> records(manifest->shard.held(manifest->elementCount));
    reader.read(std::as_writable_bytes(std::span(records)));

    // No row is read before their sizes add up.
    std::uint64_t lit = 0, rows = 0, shares = 0;
    bool plausible = true;
    for (const ElementRecord& record : records) {
        plausible = plausible && isPlausible(record);
        lit += (record.found & kHasLight) != 0 ? 1 : 0;
        rows += (record.found & kHasRow) != 0 ? 1 : 0;
        shares += record.shares;
    }
    if (!plausible)
        return reader.damaged("a value is out of range");
    const bool all = lit == records.size() && rows == manifest->shard.held(state.rows.size());
    if (lit != manifest->lit || rows != manifest->rows || shares != manifest->shares ||
        manifest->complete != all)
        return reader.damaged("its counts do not add up");

    std::size_t bytes = state.rows.shareCount() * sizeof(FactorRow::Share);
    FactorRow row;
    auto next = records.begin();
    for (std::uint32_t e = 0; e < manifest->elementCount; ++e) {
        if (!manifest->shard.holds(e))
            continue;
        const ElementRecord& record = *next++;
        if ((record.found & kHasLight) != 0 && !state.light.has(e))
            state.light.set(e, record.direct);
        if ((record.found & kHasRow) == 0)
            continue;
        if (e >= state.rows.size())
            return reader.damaged("it has rows of more patches than there are");
        row.shares.resize(record.shares);
        row.absorbed = record.absorbed;
        row.escaped = record.escaped;
        row.rays = record.rays;
        reader.read(std::as_writable_bytes(std::span(row.shares)));
        if (!isPlausible(row, manifest->elementCount))
            plausible = false;
        const std::size_t size = row.shares.size() * sizeof(FactorRow::Share);
        if (!plausible || state.rows.has(e) || (maxRowBytes > 0 && bytes + size > maxRowBytes))
            continue;
        state.rows.set(e, row);
        bytes += size;
    }
    plausible = readSolver(reader, *manifest, state.solver) && plausible;
    if (Result<void> whole = reader.finish(); !whole)
        return whole;
    if (!plausible)
        return reader.damaged("a value is out of range");
    return {};
}

} // namespace patina::radiosity

#include "core/trace/file/FilmFile.h"

#include "core/base/Check.h"
#include "core/base/Limits.h"
#include "core/trace/file/FilmTiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace patina {
namespace {

namespace fs = std::filesystem;

// The description is the manifest as JSON; the film's pixels of the shard follow, tile by tile, and
// those of the outputs.
constexpr StateFormat kFilmState = {
    {'P', 'a', 't', 'i', 'n', 'a', 'F', 'm'},
    1, // also counts changes of how pictures are traced and sampled
    "this is no part and no checkpoint of a traced picture; make parts with patina render "
    "--renderer path … --shard K/N",
    "render it anew"};
static_assert(std::is_trivially_copyable_v<Film::Pixel> &&
              std::is_trivially_copyable_v<TraceOutputs::Pixel>);

Hash filmHashFromText(const std::string& text) {
    if (text.size() != 32 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
        return {};
    return {std::stoull(text.substr(0, 16), nullptr, 16),
            std::stoull(text.substr(16), nullptr, 16)};
}

std::string filmManifestText(const FilmManifest& m) {
    nlohmann::ordered_json json;
    json["size"] = {m.width, m.height};
    json["settings"] = m.settings;
    json["display"] = m.display;
    json["geometry"] = m.inputs.geometry.hex();
    json["materials"] = m.inputs.materials.hex();
    json["lights"] = m.inputs.lights.hex();
    json["environment"] = m.inputs.environment.hex();
    json["camera"] = {m.camera.target.x, m.camera.target.y, m.camera.target.z, m.camera.yawDeg,
                      m.camera.pitchDeg, m.camera.distance, m.camera.fovDeg};
    if (const Lens& lens = m.camera.lens; !(lens == Lens{}))
        json["lens"] = {{"depthOfField", lens.depthOfField},
                        {"fStop", lens.fStop},
                        {"focusDistance", lens.focusDistance}};
    json["transparent"] = m.transparent;
    json["outputs"] = m.hasOutputs;
    json["scene"] = m.scene;
    json["sets"] = m.sets;
    json["shard"] = {m.shard.index, m.shard.count};
    json["complete"] = m.complete;
    json["samples"] = m.samples;
    json["done"] = m.done;
    // Names of files may be no UTF-8; they only tell people where the scene was.
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<FilmManifest> filmManifestFromText(const std::string& text) {
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        FilmManifest m;
        const auto side = [&](std::size_t axis) {
            constexpr std::int64_t kMost = std::numeric_limits<int>::max();
            return static_cast<int>(
                std::clamp<std::int64_t>(json.at("size").at(axis).get<std::int64_t>(), 0, kMost));
        };
        m.width = side(0);
        m.height = side(1);
        m.settings = json.at("settings").get<StateSettings>();
        m.display = json.at("display").get<StateSettings>();
        const auto hash = [&](const char* name) {
            return filmHashFromText(json.at(name).get<std::string>());
        };
        m.inputs = {hash("geometry"), hash("materials"), hash("lights"), hash("environment")};
        const auto camera = json.at("camera").get<std::array<float, 7>>();
        m.camera.target = {camera[0], camera[1], camera[2]};
        m.camera.yawDeg = camera[3];
        m.camera.pitchDeg = camera[4];
        m.camera.distance = camera[5];
        m.camera.fovDeg = camera[6];
        if (const auto lens = json.find("lens"); lens != json.end())
            m.camera.lens = {lens->at("depthOfField").get<bool>(), lens->at("fStop").get<float>(),
                             lens->at("focusDistance").get<float>()};
        m.transparent = json.at("transparent").get<bool>();
        m.hasOutputs = json.at("outputs").get<bool>();
        m.scene = json.at("scene").get<std::string>();
        m.sets = json.at("sets").get<std::vector<std::string>>();
        m.shard = {json.at("shard").at(0).get<int>(), json.at("shard").at(1).get<int>()};
        m.complete = json.at("complete").get<bool>();
        m.samples = json.at("samples").get<std::uint32_t>();
        m.done = json.at("done").get<double>();
        if (m.width == 0 || m.height == 0 || m.shard.index < 0 || m.shard.index >= m.shard.count)
            return std::nullopt;
        return m;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

Result<FilmManifest> openFilm(StateFileReader& reader) {
    const Result<std::string> text = reader.open();
    if (!text)
        return text.error();
    std::optional<FilmManifest> manifest = filmManifestFromText(*text);
    if (!manifest)
        return reader.damaged("its description makes no sense");
    for (const StateSettings* settings : {&manifest->settings, &manifest->display})
        if (Result<void> plausible = reader.check(*settings); !plausible)
            return plausible.error();
    constexpr int kMost = limits::kMaxImageSide;
    if (std::max(manifest->width, manifest->height) > kMost)
        return reader.damaged(
            fmt::format("it says that its picture has {} × {} pixels; at most {} a side are "
                        "supported",
                        manifest->width, manifest->height, kMost));
    const std::size_t each =
        sizeof(Film::Pixel) + (manifest->hasOutputs ? sizeof(TraceOutputs::Pixel) : 0);
    // No memory is taken for pixels that are not there.
    if (Result<void> fits =
            reader.expect(shardPixels(manifest->width, manifest->height, manifest->shard) * each);
        !fits)
        return fits.error();
    return std::move(manifest).value();
}

bool isPlausible(const Film::Pixel& pixel) {
    const double n = pixel.samples;
    return std::isfinite(pixel.sum.x) && std::isfinite(pixel.sum.y) && std::isfinite(pixel.sum.z) &&
           std::isfinite(pixel.squares) && pixel.squares >= 0.0 && pixel.coverage >= 0.0f &&
           static_cast<double>(pixel.coverage) <= n && std::isfinite(pixel.firstSum) &&
           pixel.invalid <= pixel.samples;
}

bool isPlausible(const TraceOutputs::Pixel& pixel) {
    const auto finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return finite(pixel.albedo) && finite(pixel.normal) && finite(pixel.position) &&
           finite(pixel.emission) && finite(pixel.background) && finite(pixel.directDiffuse) &&
           finite(pixel.directSpecular) && finite(pixel.indirectDiffuse) &&
           finite(pixel.indirectSpecular);
}

// The pixels of a shard one after another; those of a whole picture are so already.
template <class Pixel>
class HeldPixels {
  public:
    HeldPixels(const FilmManifest& manifest, std::span<Pixel> all)
        : m_manifest(manifest)
        , m_all(all) {
        if (isPart() && !all.empty())
            m_held.reserve(shardPixels(manifest.width, manifest.height, manifest.shard));
    }
    [[nodiscard]] std::span<const Pixel> gathered() {
        if (!isPart() || m_all.empty())
            return m_all;
        forRows([&](std::size_t first, std::size_t count) {
            const auto row = m_all.subspan(first, count);
            m_held.insert(m_held.end(), row.begin(), row.end());
        });
        return m_held;
    }
    // Reads them; false where one makes no sense.
    [[nodiscard]] bool readFrom(StateFileReader& reader) {
        if (!isPart()) {
            reader.read(std::as_writable_bytes(m_all));
            return std::ranges::all_of(m_all,
                                       [](const Pixel& pixel) { return isPlausible(pixel); });
        }
        m_held.resize(shardPixels(m_manifest.width, m_manifest.height, m_manifest.shard));
        reader.read(std::as_writable_bytes(std::span(m_held)));
        auto next = m_held.begin();
        forRows([&](std::size_t first, std::size_t count) {
            const auto end = next + static_cast<std::ptrdiff_t>(count);
            std::copy(next, end, m_all.begin() + static_cast<std::ptrdiff_t>(first));
            next = end;
        });
        return std::ranges::all_of(m_held, [](const Pixel& pixel) { return isPlausible(pixel); });
    }

  private:
    [[nodiscard]] bool isPart() const { return m_manifest.shard.count > 1; }
    template <class F>
    void forRows(const F& f) const {
        forShardRows(m_manifest.width, m_manifest.height, m_manifest.shard, f);
    }

    const FilmManifest& m_manifest;
    std::span<Pixel> m_all;
    std::vector<std::remove_const_t<Pixel>> m_held;
};

} // namespace

std::optional<std::string> whyDifferent(const FilmManifest& there, const FilmManifest& here) {
    if (there.width != here.width || there.height != here.height)
        return fmt::format("the size ({} × {} pixels there, {} × {} here)", there.width,
                           there.height, here.width, here.height);
    if (auto setting = differingSetting(there.settings, here.settings))
        return setting;
    if (auto inputs = differingInputs(there.inputs, here.inputs))
        return there.scene == here.scene
                   ? fmt::format("{} of {}, which changed", *inputs, here.scene)
                   : fmt::format("{} ({} there, {} here)", *inputs, there.scene, here.scene);
    if (there.transparent != here.transparent)
        return "the alpha channel";
    return differingSetting(there.display, here.display);
}

Result<void> writeFilm(const fs::path& file, const FilmManifest& manifest, const Film& film,
                       const TraceOutputs& outputs, StateFileName name) {
    CHECK(film.width() == manifest.width && film.height() == manifest.height);
    CHECK(outputs.empty() != manifest.hasOutputs);
    HeldPixels<const Film::Pixel> colors(manifest, film.pixels());
    HeldPixels<const TraceOutputs::Pixel> others(manifest, outputs.pixels());
    std::vector<std::span<const std::byte>> pieces{std::as_bytes(colors.gathered())};
    if (manifest.hasOutputs)
        pieces.push_back(std::as_bytes(others.gathered()));
    return writeStateFile(file, kFilmState, filmManifestText(manifest), pieces, name);
}

bool looksLikeFilm(const fs::path& file) {
    return isStateFile(file, kFilmState);
}

Result<FilmManifest> readFilmManifest(const fs::path& file) {
    StateFileReader reader(file, kFilmState);
    return openFilm(reader);
}

Result<FilmManifest> readFilm(const fs::path& file, Film& film, TraceOutputs& outputs) {
    StateFileReader reader(file, kFilmState);
    Result<FilmManifest> manifest = openFilm(reader);
    if (!manifest)
        return manifest;
    const int width = manifest->width, height = manifest->height;
    if (film.width() == 0) {
        film = Film(width, height);
        outputs = manifest->hasOutputs ? TraceOutputs(width, height) : TraceOutputs();
    }
    if (film.width() != width || film.height() != height || outputs.empty() == manifest->hasOutputs)
        return reader.damaged("it is of another picture");
    bool plausible = HeldPixels<Film::Pixel>(*manifest, film.pixels()).readFrom(reader);
    if (manifest->hasOutputs)
        plausible = HeldPixels<TraceOutputs::Pixel>(*manifest, outputs.pixels()).readFrom(reader) &&
                    plausible;
    if (Result<void> whole = reader.finish(); !whole)
        return whole.error();
    if (!plausible)
        return reader.damaged("a value is out of range");
    return manifest;
}

} // namespace patina

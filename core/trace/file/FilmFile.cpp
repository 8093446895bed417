#include "core/trace/file/FilmFile.h"

#include "core/base/Check.h"
#include "core/trace/file/FilmTiles.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace patina {
namespace {

namespace fs = std::filesystem;

// The description is the manifest as JSON; the pixels of the shard follow, tile by tile.
constexpr StateFormat kFilmState = {
    {'P', 'a', 't', 'i', 'n', 'a', 'F', 'm'},
    1, // also counts changes of how pictures are traced and sampled
    "this is no part and no checkpoint of a traced picture; make parts with patina render "
    "--renderer path … --shard K/N",
    "render it anew"};
static_assert(std::is_trivially_copyable_v<Film::Pixel>);

// A picture of more pixels than memory is not believed before its file's size is.
constexpr std::int64_t kMostSide = 1 << 20;

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
    json["transparent"] = m.transparent;
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
            const auto value = json.at("size").at(axis).get<std::int64_t>();
            return value >= 1 && value <= kMostSide ? static_cast<int>(value) : 0;
        };
        m.width = side(0);
        m.height = side(1);
        m.settings = json.at("settings").get<StateSettings>();
        m.display = json.at("display").get<StateSettings>();
        const auto hash = [&](const char* name) {
            return filmHashFromText(json.at(name).get<std::string>());
        };
        m.inputs = {hash("geometry"), hash("materials"), hash("lights"), hash("environment")};
        m.transparent = json.at("transparent").get<bool>();
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
    return std::move(manifest).value();
}

bool isPlausible(const Film::Pixel& pixel) {
    const double n = pixel.samples;
    return std::isfinite(pixel.sum.x) && std::isfinite(pixel.sum.y) && std::isfinite(pixel.sum.z) &&
           std::isfinite(pixel.squares) && pixel.squares >= 0.0 && pixel.coverage >= 0.0 &&
           pixel.coverage <= n && pixel.invalid <= pixel.samples;
}

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
                       StateFileName name) {
    CHECK(film.width() == manifest.width && film.height() == manifest.height);
    std::vector<Film::Pixel> held; // of a part; the whole is not copied
    if (manifest.shard.count > 1)
        forShardRows(film.width(), film.height(), manifest.shard,
                     [&](std::size_t first, std::size_t count) {
                         const auto row = film.pixels().subspan(first, count);
                         held.insert(held.end(), row.begin(), row.end());
                     });
    const std::span<const Film::Pixel> pixels =
        manifest.shard.count > 1 ? std::span<const Film::Pixel>(held) : film.pixels();
    const std::span<const std::byte> piece = std::as_bytes(pixels);
    return writeStateFile(file, kFilmState, filmManifestText(manifest), std::span(&piece, 1), name);
}

bool looksLikeFilm(const fs::path& file) {
    return isStateFile(file, kFilmState);
}

Result<FilmManifest> readFilmManifest(const fs::path& file) {
    StateFileReader reader(file, kFilmState);
    return openFilm(reader);
}

Result<FilmManifest> readFilm(const fs::path& file, Film& film) {
    StateFileReader reader(file, kFilmState);
    Result<FilmManifest> manifest = openFilm(reader);
    if (!manifest)
        return manifest;
    const int width = manifest->width, height = manifest->height;
    const std::size_t count = shardPixels(width, height, manifest->shard);
    if (Result<void> fits = reader.expect(count * sizeof(Film::Pixel)); !fits)
        return fits.error();
    if (film.width() == 0)
        film = Film(width, height);
    if (film.width() != width || film.height() != height)
        return reader.damaged("its picture has another size");
    std::vector<Film::Pixel> held(manifest->shard.count > 1 ? count : 0);
    const std::span<Film::Pixel> pixels =
        manifest->shard.count > 1 ? std::span<Film::Pixel>(held) : film.pixels();
    reader.read(std::as_writable_bytes(pixels));
    if (Result<void> whole = reader.finish(); !whole)
        return whole.error();
    if (!std::ranges::all_of(pixels, isPlausible))
        return reader.damaged("a value is out of range");
    if (manifest->shard.count > 1) {
        auto next = held.begin();
        forShardRows(width, height, manifest->shard, [&](std::size_t first, std::size_t length) {
            const auto end = next + static_cast<std::ptrdiff_t>(length);
            std::copy(next, end, film.pixels().begin() + static_cast<std::ptrdiff_t>(first));
            next = end;
        });
    }
    return manifest;
}

} // namespace patina

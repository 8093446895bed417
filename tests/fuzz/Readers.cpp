#include "tests/fuzz/Readers.h"

#include "core/bake/domain/BakePoints.h"
#include "core/bake/file/BakeIO.h"
#include "core/bake/transfer/BakeCheckpoint.h"
#include "core/bake/transfer/BakeMerge.h"
#include "core/bracket/Bracket.h"
#include "core/catalog/CatalogCache.h"
#include "core/catalog/EnvironmentThumbnail.h"
#include "core/document/Document.h"
#include "core/edit/Edit.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/io/ImageIO.h"
#include "core/light/IblCache.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/radiosity/document/Reexpose.h"
#include "core/radiosity/file/RadiosityFile.h"
#include "core/radiosity/file/RadiosityMerge.h"
#include "core/radiosity/file/SolutionCache.h"
#include "core/recovery/RecoveryRecord.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"
#include "core/trace/file/FilmFile.h"
#include "core/trace/file/FilmMerge.h"
#include "tests/core/worker/ModelFiles.h"
#include "tests/support/ExifTiff.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

namespace patina::test {
namespace {

namespace fs = std::filesystem;

std::string bytesOfFile(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Outcome refused(const Error& error) {
    const std::string text = error.text();
    if (text.find("took longer than") != std::string::npos)
        return Outcome::TimedOut;
    if (text.find("decoder crash") != std::string::npos ||
        text.find("without an answer") != std::string::npos)
        return Outcome::Died;
    return error.message.empty() || error.kind == ErrorKind::Internal ? Outcome::Broken
                                                                      : Outcome::Rejected;
}

template <class T>
Outcome outcomeOf(const Result<T>& result) {
    return result.ok() ? Outcome::Loaded : refused(result.error());
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isSound(const Mesh& mesh) {
    const std::size_t n = mesh.vertexCount();
    return mesh.normals.size() == n && mesh.uvs.size() == n &&
           std::ranges::all_of(mesh.indices, [n](std::uint32_t index) { return index < n; }) &&
           std::ranges::all_of(mesh.positions, isFinite) &&
           std::ranges::all_of(mesh.normals, isFinite);
}

// --- Models and pictures -------------------------------------------------------------------------

Outcome readModel(WorkerClient& worker, const Document& empty, const fs::path& file) {
    Document document = empty;
    const Result<std::vector<Notice>> added = addModel(worker, document, file.string());
    if (!added)
        return refused(added.error());
    for (const MeshInstance& mesh : document.meshes)
        if (!mesh.mesh || !isSound(*mesh.mesh))
            return Outcome::Broken;
    return document.meshes.empty() ? Outcome::Broken : Outcome::Loaded;
}

Outcome readPicture(WorkerClient& worker, const fs::path& file, Random& random) {
    const Result<LoadedImage> loaded = loadImage(worker, file, {});
    if (!loaded)
        return refused(loaded.error());
    const Image& image = loaded->image();
    if (image.empty())
        return Outcome::Broken;
    if (image.type() == PixelType::F32)
        for (const float sample : image.f32())
            if (!(sample >= 0.0f) || std::isinf(sample))
                return Outcome::Broken;
    if (random() % 4 != 0)
        return Outcome::Loaded;
    std::vector<Notice> notices;
    return outcomeOf(loadEnvironmentImage(worker, file.string(), notices));
}

Outcome readPhotos(WorkerClient& worker, const fs::path& file, const fs::path& sound,
                   Random& random) {
    static_cast<void>(readExposure(worker, file).ok());
    BracketOptions options;
    if (random() % 2 == 0)
        options.exposuresEv = {0.0, 2.0};
    options.align = random() % 4 == 0;
    return outcomeOf(makeBracket(worker, std::vector<fs::path>{sound, file}, options));
}

// --- Documents -----------------------------------------------------------------------------------

// What was read can be written, and reads as the same again.
Outcome isKept(const Document& document, const fs::path& file) {
    const std::string text = documentToJson(document, file);
    const Result<Document> again = documentFromJson(text, file);
    return again.ok() && documentToJson(*again, file) == text ? Outcome::Loaded : Outcome::Broken;
}

Outcome readProject(WorkerClient& worker, const fs::path& file, Random& random) {
    const Result<Document> values = documentFromJson(bytesOfFile(file), file);
    if (!values)
        return refused(values.error());
    if (isKept(*values, file) == Outcome::Broken)
        return Outcome::Broken;
    return random() % 4 == 0 ? outcomeOf(loadProject(worker, file)) : Outcome::Loaded;
}

Outcome readRecord(const fs::path& file) {
    const Result<RecoveryRecord> record = readRecoveryRecord(file);
    if (!record)
        return refused(record.error());
    const Result<Document> values = documentFromJson(record->project, record->projectFile());
    return values ? isKept(*values, record->projectFile()) : refused(values.error());
}

Outcome readCollada(const fs::path& file) {
    const Result<ColladaDocument> document = ColladaDocument::read(file);
    if (!document)
        return refused(document.error());
    for (std::size_t i = 0; i < std::min<std::size_t>(document->instances().size(), 20); ++i) {
        const Result<ColladaMesh> mesh = document->mesh(i);
        if (mesh && !isSound(mesh->mesh))
            return Outcome::Broken;
    }
    return Outcome::Loaded;
}

// --- States of work under way --------------------------------------------------------------------

Outcome readBakePart(const fs::path& file) {
    const Result<std::vector<BakePart>> parts = readBakeParts(std::vector<fs::path>{file});
    const Result<BakeManifest> manifest = readBakeManifest(file);
    if (!manifest)
        return refused(manifest.error());
    // As many points in as many ranges as it says, as a scene would have them.
    constexpr std::uint64_t kMost = 200'000;
    if (manifest->points > kMost || manifest->ranges > manifest->points || manifest->ranges == 0)
        return Outcome::Loaded;
    std::vector<PointRange> ranges(manifest->ranges);
    const std::size_t each = rangeSize(manifest->points);
    std::size_t first = 0;
    for (PointRange& range : ranges) {
        range = {first, std::min<std::size_t>(each, manifest->points - first)};
        first += range.count;
    }
    ranges.back().count += manifest->points - first;
    for (const int stride : {1, 4, 9, 16, 25}) {
        PassState state;
        static_cast<void>(readBakeState(file, ranges, stride, state).ok());
    }
    return outcomeOf(parts);
}

Outcome readRadiosityPart(const fs::path& file) {
    using namespace radiosity;
    const Result<std::vector<RadiosityPart>> parts =
        readRadiosityParts(std::vector<fs::path>{file});
    const Result<RadiosityManifest> manifest = readRadiosityManifest(file);
    if (!manifest)
        return refused(manifest.error());
    static_cast<void>(readDivisions(file).ok());
    constexpr std::uint64_t kMost = 200'000;
    if (manifest->elementCount <= kMost) {
        SolveState state(manifest->elementCount);
        static_cast<void>(readRadiosity(file, std::size_t{1} << 28, state).ok());
    }
    return outcomeOf(parts);
}

Outcome readPart(const fs::path& file) {
    if (looksLikeCheckpoint(file))
        return readBakePart(file);
    if (radiosity::looksLikeRadiosity(file))
        return readRadiosityPart(file);
    const Result<JoinedFilm> film = joinFilms(std::vector<fs::path>{file});
    if (film)
        static_cast<void>(film->film.radiance(true));
    return outcomeOf(film);
}

// --- Caches --------------------------------------------------------------------------------------

// Puts the mutant where the cache looks for it.
template <class Cache, class Find>
Outcome readCached(const fs::path& file, const Find& find) {
    const TemporaryFolder folder;
    const Cache cache(folder.path());
    std::error_code error;
    fs::copy_file(file, cache.file(Hash{}), error);
    return find(cache) ? Outcome::Loaded : Outcome::Rejected;
}

Outcome readCachedLight(const fs::path& file) {
    std::optional<IblMaps> maps;
    const Outcome outcome = readCached<IblCache>(
        file, [&](const IblCache& cache) { return (maps = cache.find(Hash{})).has_value(); });
    return maps && maps->prefiltered.empty() ? Outcome::Broken : outcome;
}

std::vector<std::string> cachedLights() {
    const TemporaryFolder folder;
    const IblCache cache(folder.path());
    IblSettings settings;
    settings.cubeSize = 16;
    settings.levels = 4;
    settings.irradianceSize = 8;
    Image environment(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(environment.f32(), 0.5f);
    const Result<IblMaps> maps = computeIbl(environment, settings, {});
    if (!maps || !cache.store(Hash{}, *maps))
        return {};
    return {bytesOfFile(cache.file(Hash{}))};
}

std::vector<std::string> cachedEntries() {
    const TemporaryFolder folder;
    const CatalogCache cache(folder.path());
    CatalogEntry entry;
    entry.source = "/tmp/a.hdr";
    entry.title = "a";
    entry.width = 16;
    entry.height = 8;
    entry.layout = "Lat-long";
    entry.thumbnail =
        Image(kThumbnailWidth, kThumbnailHeight, 3, PixelType::U8, ColorEncoding::Srgb);
    entry.notices = {"one", "two"};
    entry.harmonics.assign(64, glm::vec3(0.25f));
    if (!cache.store(Hash{}, entry))
        return {};
    return {bytesOfFile(cache.file(Hash{}))};
}

std::vector<std::string> cachedSolutions() {
    using namespace radiosity;
    const TemporaryFolder folder;
    const SolutionCache cache(folder.path());
    std::vector<std::string> seeds;
    KeptSolution solution;
    solution.direct.assign(12, glm::dvec3(1.0));
    solution.bounced.assign(12, glm::dvec3(0.5));
    if (cache.store(Hash{}, solution))
        seeds.push_back(bytesOfFile(cache.file(Hash{})));
    KeptDivision division;
    division.rounds = {{0, 3, 5}, {7, 9}};
    if (cache.store(Hash{}, division))
        seeds.push_back(bytesOfFile(cache.file(Hash{})));
    return seeds;
}

Outcome readCachedSolution(const fs::path& file, Random& random) {
    using radiosity::SolutionCache;
    const bool division = random() % 2 == 0;
    return readCached<SolutionCache>(file, [division](const SolutionCache& cache) {
        return division ? cache.findDivision(Hash{}).has_value()
                        : cache.find(Hash{}, 12).has_value();
    });
}

// --- Seeds ---------------------------------------------------------------------------------------

std::vector<std::string> projects(const fs::path& file) {
    Document document = startDocument();
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot,
                                 LightType::Sphere, LightType::Rectangle}) {
        Light light;
        light.type = type;
        addLight(document, light);
    }
    duplicateEnvironment(document, document.mix.first);
    return {documentToJson(document, file), documentToJson(startDocument(), file)};
}

std::vector<std::string> records(const std::vector<std::string>& documents) {
    const TemporaryFolder folder;
    std::vector<std::string> seeds;
    for (const std::string& text : documents) {
        RecoveryRecord record;
        record.name = "a.patina";
        record.file = "/tmp/a.patina";
        record.steps = 3;
        record.lastStep = "Change Roughness";
        record.bakes = {{BakeKind::AoTexel, {}, {}, 16}};
        record.leftOut = {"a bake"};
        record.outside = {"/tmp/b.png"};
        record.project = text;
        if (writeRecoveryRecord(folder / "work.recovery", record))
            seeds.push_back(bytesOfFile(folder / "work.recovery"));
    }
    return seeds;
}

std::vector<std::string> filesOf(const fs::path& folder) {
    std::vector<std::string> files;
    std::error_code error;
    std::vector<fs::path> paths;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->is_regular_file(error))
            paths.push_back(entry->path());
    std::ranges::sort(paths); // the same mutants everywhere
    for (const fs::path& path : paths)
        files.push_back(bytesOfFile(path));
    return files;
}

Image photo(int step) {
    Image image(24, 16, 3, PixelType::U8, ColorEncoding::Srgb);
    const std::span<std::uint8_t> samples = image.u8();
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::uint8_t>(std::min<std::size_t>(255, i * 5 % 200 + 20 * step));
    return image;
}

} // namespace

std::map<std::string, FuzzKind> fuzzKinds(WorkerClient& worker, const fs::path& seeds) {
    std::map<std::string, FuzzKind> kinds;
    const auto empty = std::make_shared<Document>(startDocument());
    empty->meshes.clear();
    const auto model = [&worker, empty](const fs::path& file, Random&) {
        return readModel(worker, *empty, file);
    };
    const auto picture = [&worker](const fs::path& file, Random& random) {
        return readPicture(worker, file, random);
    };
    const std::vector<std::string> texts{"gltf", "obj", "dae"};
    for (auto& [format, files] : seedFiles(worker)) {
        const auto& models = modelExtensions();
        const bool isModel = std::ranges::find(models, "." + format) != models.end();
        FuzzKind& kind = kinds[format];
        kind.file = "mutant." + format;
        kind.mutate = std::ranges::find(texts, format) != texts.end() ? mutateText : mutateBytes;
        if (format == "png")
            kind.mutate = mutatePng;
        if (isModel)
            kind.read = model;
        else
            kind.read = picture;
        kind.seeds = std::move(files);
    }

    const std::vector<std::string> documents = projects("/tmp/a.patina");
    kinds["project"] = {"mutant.patina", mutateText,
                        [&worker](const fs::path& file, Random& random) {
                            return readProject(worker, file, random);
                        },
                        documents};
    kinds["recovery"] = {"work.recovery", mutateRecord,
                         [](const fs::path& file, Random&) { return readRecord(file); },
                         records(documents)};
    kinds["collada"] = {"mutant.dae",
                        mutateText,
                        [](const fs::path& file, Random&) { return readCollada(file); },
                        {daeQuad("0.01", "Z_UP"), daeQuad("1", "Y_UP")}};
    kinds["parts"] = {"mutant.part",
                      mutateState,
                      [](const fs::path& file, Random&) { return readPart(file); },
                      {}};
    const auto scene = std::make_shared<const Document>(
        openScene(worker, "builtin:plane").value().document); // what the bakes are of
    kinds["bakes"] = {"mutant.exr",
                      mutateBytes,
                      [&worker, scene](const fs::path& file, Random&) {
                          return outcomeOf(loadBake(worker, file, *scene));
                      },
                      {}};
    for (const char* extension : {"glb", "ply", "dae"})
        kinds[std::string("solved-") + extension] = {
            std::string("mutant.") + extension,
            extension == std::string("dae") ? mutateText : mutateBytes,
            [&worker](const fs::path& file, Random&) {
                const TemporaryFolder out;
                return outcomeOf(
                    reexpose(worker, file, out / ("out" + file.extension().string()), {}, {}));
            },
            {}};
    kinds["cached-light"] = {"mutant", mutateCached,
                             [](const fs::path& file, Random&) { return readCachedLight(file); },
                             cachedLights()};
    kinds["cached-catalog"] = {
        "mutant", mutateCached,
        [](const fs::path& file, Random&) {
            return readCached<CatalogCache>(
                file, [](const CatalogCache& cache) { return cache.find(Hash{}).has_value(); });
        },
        cachedEntries()};
    kinds["cached-radiosity"] = {"mutant", mutateCached, readCachedSolution, cachedSolutions()};
    const auto folder = std::make_shared<TemporaryFolder>();
    const fs::path sound = folder->write("sound.tif", tiffWithExposure(photo(0), 0.01));
    kinds["photos"] = {"mutant.tif",
                       mutateBytes,
                       [&worker, folder, sound](const fs::path& file, Random& random) {
                           return readPhotos(worker, file, sound, random);
                       },
                       {tiffWithExposure(photo(2), 0.04), tiffWithExposure(photo(4), 0.08)}};

    for (auto& [name, kind] : kinds)
        for (std::string& file : filesOf(seeds / name))
            kind.seeds.push_back(std::move(file));
    return kinds;
}

} // namespace patina::test

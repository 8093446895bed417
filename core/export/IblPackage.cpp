#include "core/export/IblPackage.h"

#include "core/base/Check.h"
#include "core/export/ShFile.h"
#include "core/image/Dds.h"
#include "core/image/Ktx2.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kManifestFormat = "patina-ibl";
constexpr const char* kRoughnessKey = "PatinaPerceptualRoughness"; // of each level, KTX2
constexpr std::size_t kMaxManifestBytes = std::size_t{1} << 20;
constexpr std::array<const char*, 6> kFaceNames = {"px", "nx", "py", "ny", "pz", "nz"};

Bytes toBytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

const char* texelName(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        return "half";
    case TexelFormat::Rgba32F:
        return "float";
    case TexelFormat::Rgb9E5:
        return "rgb9e5";
    }
    return "";
}

// A file of the package before it is encoded.
struct Picture {
    std::string name;
    const CubeLevel* level = nullptr;
    int face = -1; // -1: unrolled to a lat-long image
};

Image faceImage(const CubeLevel& level, int face) {
    Image image(level.size, level.size, 3, PixelType::F32, ColorEncoding::Linear);
    const auto count = static_cast<std::ptrdiff_t>(level.size) * level.size;
    const std::span<float> out = image.f32();
    std::size_t i = 0;
    for (auto texel = level.texels.begin() + face * count;
         texel != level.texels.begin() + (face + 1) * count; ++texel)
        for (int c = 0; c < 3; ++c)
            out[i++] = (*texel)[c];
    return image;
}

// Cuts what a half float cannot hold; returns how many pixels that were.
std::size_t clampPixels(Image& image, float largest) {
    std::size_t clamped = 0;
    const std::span<float> samples = image.f32();
    for (std::size_t i = 0; i < samples.size(); i += 3) {
        bool cut = false;
        for (std::size_t c = i; c < i + 3; ++c) {
            cut |= samples[c] > largest;
            samples[c] = std::min(samples[c], largest);
        }
        clamped += cut ? 1 : 0;
    }
    return clamped;
}

FloatTexture cubeTexture(std::span<const CubeLevel> levels) {
    FloatTexture texture;
    texture.faces = 6;
    texture.width = texture.height = levels.front().size;
    for (const CubeLevel& level : levels)
        texture.levels.push_back(level.texels);
    return texture;
}

FloatTexture tableTexture(const Image& table) {
    FloatTexture texture;
    texture.width = table.width();
    texture.height = table.height();
    std::vector<glm::vec3>& texels = texture.levels.emplace_back();
    const std::span<const float> samples = table.f32();
    for (std::size_t i = 0; i < samples.size(); i += 3)
        texels.emplace_back(samples[i], samples[i + 1], samples[i + 2]);
    return texture;
}

class Packer {
  public:
    Packer(WorkerClient& worker, const IblMaps& maps, const Image& dfgTable,
           const IblPackageSource& source, const IblPackageSettings& settings,
           const JobContext& job)
        : m_worker(worker)
        , m_maps(maps)
        , m_dfgTable(dfgTable)
        , m_source(source)
        , m_settings(settings)
        , m_job(job) {
        CHECK(!maps.prefiltered.empty());
        CHECK(maps.spacing == LevelSpacing::Even); // as mip levels are looked up
        CHECK_LE(1, maps.irradiance.size);
        CHECK(settings.format != IblFileFormat::Exr || settings.texels != TexelFormat::Rgb9E5);
    }

    Result<IblPackage> pack() {
        const bool containers =
            m_settings.format == IblFileFormat::Ktx2 || m_settings.format == IblFileFormat::Dds;
        if (Result<void> done = containers ? addContainers() : addPictures(); !done)
            return done.error();
        addHarmonics();
        if (m_job.cancelled())
            return cancelled();
        addManifest();
        m_job.setProgress(1.0);
        return std::move(m_package);
    }

  private:
    static Error cancelled() {
        return {ErrorKind::Cancelled, "the bake was cancelled; nothing was written", {}, {}};
    }

    [[nodiscard]] const char* extension() const {
        switch (m_settings.format) {
        case IblFileFormat::Exr:
            return ".exr";
        case IblFileFormat::Hdr:
            return ".hdr";
        case IblFileFormat::Ktx2:
            return ".ktx2";
        case IblFileFormat::Dds:
            return ".dds";
        }
        return "";
    }

    Result<void> addContainers() {
        m_job.setActivity("packing textures");
        const TexelFormat tableTexels =
            m_settings.texels == TexelFormat::Rgba32F ? TexelFormat::Rgba32F : TexelFormat::Rgba16F;
        m_prefilteredFiles =
            Json::array({addContainer("prefiltered", cubeTexture(m_maps.prefiltered),
                                      m_settings.texels, {{kRoughnessKey, roughnessText()}})});
        m_job.setProgress(0.7);
        m_irradianceFiles = Json::array({addContainer(
            "irradiance", cubeTexture(std::span(&m_maps.irradiance, 1)), m_settings.texels)});
        m_dfgFile = addContainer("dfg", tableTexture(m_dfgTable), tableTexels);
        return {};
    }

    [[nodiscard]] float roughness(std::size_t level) const {
        return levelRoughness(m_maps.spacing, static_cast<int>(level),
                              static_cast<int>(m_maps.prefiltered.size()),
                              m_maps.prefiltered.front().size);
    }
    // "0 0.25 0.5 0.75 1"
    [[nodiscard]] std::string roughnessText() const {
        std::string text;
        for (std::size_t i = 0; i < m_maps.prefiltered.size(); ++i)
            text += fmt::format("{}{}", i > 0 ? " " : "", roughness(i));
        return text;
    }

    // `values`: of a KTX2 file; DDS has no place for them.
    std::string addContainer(const char* stem, const FloatTexture& texture, TexelFormat texels,
                             const std::map<std::string, std::string>& values = {}) {
        EncodedTexture encoded = m_settings.format == IblFileFormat::Ktx2
                                     ? encodeKtx2(texture, texels, values)
                                     : encodeDds(texture, texels);
        m_package.clamped += encoded.clamped;
        m_package.files.push_back({stem + std::string(extension()), std::move(encoded.file)});
        return m_package.files.back().name;
    }

    // One file per face, or per level, encoded side by side.
    Result<void> addPictures() {
        std::vector<Picture> pictures;
        const auto add = [&](const std::string& stem, const CubeLevel& level) {
            Json names = Json::array();
            const bool faces = m_settings.layout == IblLayout::Faces;
            for (int face = faces ? 0 : -1; face < (faces ? 6 : 0); ++face) {
                const std::string suffix = faces ? std::string("-") + kFaceNames[face] : "";
                pictures.push_back({stem + suffix + extension(), &level, face});
                names.push_back(pictures.back().name);
            }
            return names;
        };
        for (std::size_t i = 0; i < m_maps.prefiltered.size(); ++i)
            m_prefilteredFiles.push_back(
                add(fmt::format("prefiltered-{}", i), m_maps.prefiltered[i]));
        m_irradianceFiles = add("irradiance", m_maps.irradiance);

        m_job.setActivity("encoding images");
        std::vector<std::optional<Result<Bytes>>> encoded(pictures.size());
        std::atomic<std::size_t> done = 0, clamped = 0;
        parallelFor(m_job, pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Picture& picture = pictures[i];
                Image image = picture.face >= 0 ? faceImage(*picture.level, picture.face)
                                                : latLongFromCube(*picture.level, m_job);
                if (half())
                    clamped += clampPixels(image, largestValue(TexelFormat::Rgba16F));
                encoded[i] = encode(image);
                m_job.setProgress(0.9 * static_cast<double>(++done) /
                                  static_cast<double>(pictures.size()));
            }
        });
        if (m_job.cancelled())
            return cancelled();
        m_package.clamped = clamped;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            if (!encoded[i]->ok())
                return encoded[i]->error();
            m_package.files.push_back({pictures[i].name, std::move(**encoded[i])});
        }

        Result<Bytes> table = encodeImage(m_worker, m_dfgTable, ImageFileFormat::Exr, {half(), 0});
        if (!table)
            return table.error();
        m_dfgFile = "dfg.exr";
        m_package.files.push_back({m_dfgFile, std::move(*table)});
        return {};
    }

    [[nodiscard]] bool half() const {
        return m_settings.format == IblFileFormat::Exr && m_settings.texels == TexelFormat::Rgba16F;
    }

    Result<Bytes> encode(const Image& image) {
        const ImageFileFormat format =
            m_settings.format == IblFileFormat::Exr ? ImageFileFormat::Exr : ImageFileFormat::Hdr;
        return encodeImage(m_worker, image, format, {half(), 0});
    }

    void addHarmonics() {
        const auto add = [&](const char* stem, std::span<const glm::vec3> coefficients,
                             ShQuantity quantity) {
            m_package.files.push_back(
                {stem + std::string(".json"), toBytes(shJson(coefficients, quantity))});
            m_package.files.push_back(
                {stem + std::string(".txt"), toBytes(shText(coefficients, quantity))});
        };
        add("irradiance-sh", m_maps.irradianceSh, ShQuantity::Irradiance);
        add("radiance-sh", std::span(m_maps.radianceSh).first(25), ShQuantity::Radiance);
    }

    void addManifest() {
        const bool hdr = m_settings.format == IblFileFormat::Hdr;
        Json root;
        root["format"] = kManifestFormat;
        root["version"] = 1;
        root["generator"] = "Patina " PATINA_VERSION;
        root["environment"] = {{"source", m_source.environment},
                               {"rotationDeg", m_source.orientation.rotationDeg},
                               {"exposureEv", m_source.exposureEv}};
        if (!m_source.orientation.isLevel()) {
            root["environment"]["tiltDeg"] = m_source.orientation.tiltDeg;
            root["environment"]["rollDeg"] = m_source.orientation.rollDeg;
        }
        root["conventions"] = conventions();

        Json levels = Json::array();
        const std::size_t count = m_maps.prefiltered.size();
        for (std::size_t i = 0; i < count; ++i) {
            const double r = static_cast<double>(i) / static_cast<double>(count - 1);
            Json level = {
                {"size", m_maps.prefiltered[i].size}, {"perceptualRoughness", r}, {"alpha", r * r}};
            if (m_settings.format == IblFileFormat::Exr || hdr)
                level["files"] = m_prefilteredFiles[i];
            levels.push_back(std::move(level));
        }
        root["prefiltered"] = {{"texels", hdr ? "rgbe" : texelName(m_settings.texels)},
                               {"levels", std::move(levels)}};
        if (m_settings.format == IblFileFormat::Ktx2 || m_settings.format == IblFileFormat::Dds)
            root["prefiltered"]["files"] = m_prefilteredFiles;
        root["irradiance"] = {{"size", m_maps.irradiance.size}, {"files", m_irradianceFiles}};
        root["dfg"] = {{"width", m_dfgTable.width()},
                       {"height", m_dfgTable.height()},
                       {"distribution", m_source.distribution},
                       {"visibility", m_source.visibility},
                       {"files", Json::array({m_dfgFile})}};
        root["sphericalHarmonics"] = {
            {"irradiance", Json::array({"irradiance-sh.json", "irradiance-sh.txt"})},
            {"radiance", Json::array({"radiance-sh.json", "radiance-sh.txt"})}};
        root["clampedTexels"] = m_package.clamped;
        Json names = Json::array({kManifest});
        for (const FolderFile& file : m_package.files)
            names.push_back(file.name);
        root["files"] = std::move(names);
        m_package.files.push_back({kManifest, toBytes(root.dump(2) + "\n")});
    }

    [[nodiscard]] Json conventions() const {
        Json text;
        text["frame"] = "right-handed, +Y up, metres; the middle of a lat-long image is -Z: "
                        "u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi, row 0 on top";
        text["color"] = "linear, Rec. 709 primaries, in the environment's unit of radiance";
        text["prefiltered"] =
            "mean of radiance l with weight D(h) N.L, GGX, N = V = R (Karis 2013); level i of n: "
            "perceptual roughness i / (n - 1), alpha its square; level 0 is the environment; "
            "between levels a linear mix in perceptual roughness is continuous, not exact";
        text["irradiance"] = "E(n): integral of L(l) max(n.l, 0) dl; divide by pi for the "
                             "radiance of a white surface";
        text["dfg"] =
            "u = N.V, v = perceptual roughness, texel centres at (i + 0.5) / n, row 0 is the "
            "smoothest; R scales F0, G is added: albedo = F0 R + G, single scattering; B tilts the "
            "lookup: the lobe's mean direction is normalize(mix(N, reflected V, B))";
        if (m_settings.format == IblFileFormat::Ktx2 || m_settings.format == IblFileFormat::Dds ||
            m_settings.layout == IblLayout::Faces)
            text["faces"] = "+X -X +Y -Y +Z -Z, first row on top, as OpenGL, Vulkan and Direct3D "
                            "address them (OpenGL 4.6, table 8.19): look up with the direction "
                            "(x, y, z) as it is. To the right in the image of +Z lies +X: mirrored "
                            "against what is seen from inside";
        return text;
    }

    WorkerClient& m_worker;
    const IblMaps& m_maps;
    const Image& m_dfgTable;
    const IblPackageSource& m_source;
    const IblPackageSettings& m_settings;
    const JobContext& m_job;
    IblPackage m_package;
    Json m_prefilteredFiles = Json::array(), m_irradianceFiles;
    std::string m_dfgFile;
};

} // namespace

Result<IblPackage> packIbl(WorkerClient& worker, const IblMaps& maps, const Image& dfgTable,
                           const IblPackageSource& source, const IblPackageSettings& settings,
                           const JobContext& job) {
    return Packer(worker, maps, dfgTable, source, settings, job).pack();
}

bool isIblPackage(const fs::path& folder) {
    const Result<std::string> text = readTextFile(folder / kManifest, kMaxManifestBytes);
    if (!text)
        return false;
    const Json root = Json::parse(*text, nullptr, false);
    if (!root.is_object() || root.value("format", Json()) != kManifestFormat ||
        !root.value("files", Json()).is_array())
        return false;
    std::set<std::string> known;
    for (const Json& name : root["files"])
        if (name.is_string())
            known.insert(name.get<std::string>());
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (!entry.is_regular_file(error) || !known.contains(entry.path().filename().string()))
            return false;
    return !error;
}

} // namespace patina

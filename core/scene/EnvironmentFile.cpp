#include "core/scene/EnvironmentFile.h"

#include "core/base/LowerCase.h"
#include "core/edit/Parameters.h"
#include "core/image/Chromaticities.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/EnvironmentResample.h"
#include "core/scene/SceneLoader.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Layout = EnvironmentLayout;

constexpr int kMaxFace = 2048;

// Names of the faces +X -X +Y -Y +Z -Z as they end file names.
constexpr std::array<std::array<std::string_view, 6>, 6> kFaceNames{{
    {"px", "nx", "py", "ny", "pz", "nz"},
    {"posx", "negx", "posy", "negy", "posz", "negz"},
    {"+x", "-x", "+y", "-y", "+z", "-z"},
    {"right", "left", "top", "bottom", "front", "back"},
    {"right", "left", "up", "down", "front", "back"},
    {"rt", "lf", "up", "dn", "ft", "bk"},
}};

// In the spelling of what was there: "PX" for "NZ", "Left" for "Right".
std::string inCaseOf(std::string_view name, std::string_view like) {
    std::string result(name);
    const auto upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    const auto raise = [](char& c) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    };
    const auto letter =
        std::ranges::find_if(like, [](unsigned char c) { return std::isalpha(c) != 0; });
    const bool first = letter != like.end() && upper(*letter);
    const bool last = !like.empty() && upper(like.back());
    for (std::size_t i = 0; i < result.size(); ++i)
        if ((i == 0 && first) || (last && (first || i + 1 == result.size())))
            raise(result[i]);
    return result;
}

// RGB floats in linear Rec.709, whatever the file has.
Image toLinearRgb(const LoadedImage& loaded) {
    const Image& image = loaded.image();
    Image result(image.width(), image.height(), 3, PixelType::F32, ColorEncoding::Linear);
    std::optional<glm::mat3> matrix;
    const auto& attributes = loaded.parts.front().attributes;
    if (const auto text = attributes.find("chromaticities"); text != attributes.end())
        if (const auto chromaticities = parseChromaticities(text->second);
            chromaticities && *chromaticities != kRec709)
            matrix = toRec709(*chromaticities);
    auto target = result.f32().begin();
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            glm::vec3 color = image.linear(x, y);
            if (matrix) // colours that Rec.709 cannot show become its nearest
                color = glm::max(*matrix * color, glm::vec3(0.0f));
            for (int c = 0; c < 3; ++c)
                *target++ = color[c];
        }
    return result;
}

struct ReadImage {
    Image image;
    std::map<std::string, std::string> attributes;
    std::size_t repaired = 0;
    bool integers = false;
};

Result<ReadImage> readImage(WorkerClient& worker, const fs::path& file, int maxSide) {
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    options.colorOnly = true;
    options.maxSide = maxSide;
    const Result<LoadedImage> loaded = loadImage(worker, file, options);
    if (!loaded)
        return loaded.error();
    return ReadImage{toLinearRgb(*loaded), loaded->parts.front().attributes,
                     loaded->sanitizedSamples, loaded->image().type() != PixelType::F32};
}

glm::vec3 pixel(const Image& image, int x, int y) {
    return glm::vec3(image.linear(x, y));
}

// The brightest and the darkest value of the pixels that `belongs` chooses, over all channels.
template <class Belongs>
std::pair<float, float> range(const Image& image, const Belongs& belongs) {
    float low = 1e30f, high = 0.0f;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (belongs(x, y)) {
                const glm::vec3 p = pixel(image, x, y);
                low = std::min({low, p.x, p.y, p.z});
                high = std::max({high, p.x, p.y, p.z});
            }
    return {low, high};
}

// Unused cells of a cross have one colour, mostly black.
bool hasEmptyCells(const Image& image, ImageSize faces) {
    const int n = image.width() / faces.width;
    const auto unused = [&](int x, int y) {
        const int column = x / n, row = y / n;
        return faces.width == 4 ? row != 1 && column != 1 : column != 1 && row != 1;
    };
    const auto [low, high] = range(image, unused);
    return high - low <= 0.02f * high + 1e-4f;
}

// A probe is a disc on black.
bool hasBlackCorners(const Image& image) {
    const float radius = 0.5f * static_cast<float>(image.width());
    const auto outside = [&](int x, int y) {
        const float dx = static_cast<float>(x) + 0.5f - radius;
        const float dy = static_cast<float>(y) + 0.5f - radius;
        return dx * dx + dy * dy > (radius + 2.0f) * (radius + 2.0f);
    };
    const auto inside = [&](int x, int y) { return !outside(x, y); };
    const auto corners = range(image, outside);
    const auto disc = range(image, inside);
    return corners.second <= 1e-3f * disc.second && disc.second > 0.0f;
}

Error asInputError(Error error, const fs::path& file) {
    error.file = file;
    return error;
}

Result<EnvironmentPicture> makePicture(Image image, Layout layout, EnvironmentConvention convention,
                                       const fs::path& file) {
    Result<EnvironmentMapping> mapping =
        EnvironmentMapping::create(layout, {image.width(), image.height()}, convention);
    if (!mapping)
        return asInputError(mapping.error(), file);
    return EnvironmentPicture{std::move(image), layout, convention, *mapping};
}

bool exist(const std::vector<fs::path>& files) {
    std::error_code ignored;
    return !files.empty() && std::ranges::all_of(files, [&](const fs::path& file) {
        return fs::is_regular_file(file, ignored);
    });
}

void addNotices(const ReadImage& read, const fs::path& file, std::vector<Notice>& notices) {
    if (read.repaired > 0)
        notices.push_back({repairedText(read.repaired), file});
    if (read.integers)
        notices.push_back(
            {"this picture has no high dynamic range, so that its light sources and windows "
             "light the scene too weakly; use an .hdr or .exr file for real light",
             file});
}

// Six square pictures of one size, stacked.
Result<EnvironmentPicture> readSixFaces(WorkerClient& worker, const fs::path& file,
                                        const std::vector<fs::path>& files, const ReadImage& first,
                                        std::vector<Notice>& notices, const JobContext& job) {
    const int size = std::min(first.image.width(), kMaxFace);
    Image stacked(size, 6 * size, 3, PixelType::F32, ColorEncoding::Linear);
    ReadImage sum;
    for (std::size_t i = 0; i < 6; ++i) {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "reading was cancelled", file, {}};
        job.setProgress(static_cast<double>(i) / 6.0);
        std::error_code ignored;
        Result<ReadImage> face =
            fs::equivalent(files[i], file, ignored)
                ? Result<ReadImage>(first) // perhaps more than once: files may be links
                : readImage(worker, files[i], kMaxFace);
        if (!face)
            return face.error();
        const Image image = shrinkImage(face->image, kMaxFace); // integers come as they are
        if (image.width() != size || image.height() != size)
            return Error{ErrorKind::InputBroken,
                         fmt::format("this face has {} × {} pixels, but {} has {} × {}; the six "
                                     "faces must be squares of one size",
                                     image.width(), image.height(), file.filename().string(), size,
                                     size),
                         files[i],
                         {}};
        std::ranges::copy(image.f32(), stacked.f32().begin() +
                                           static_cast<std::ptrdiff_t>(i * image.f32().size()));
        sum.repaired += face->repaired;
        sum.integers = sum.integers || face->integers;
    }
    addNotices(sum, file, notices);
    return makePicture(std::move(stacked), Layout::SixFaces, EnvironmentConvention::Common, file);
}

// A picture of other proportions as twice as wide as high; neither side gets smaller.
Image stretched(const Image& picture) {
    const int width = std::max(2, std::max(picture.width(), 2 * picture.height()) / 2 * 2);
    Image result(width, width / 2, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> texels = result.f32();
    const float halfTexel = 0.5f / static_cast<float>(picture.height());
    parallelFor(
        {}, static_cast<std::size_t>(result.height()), 16, [&](std::size_t begin, std::size_t end) {
            for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                for (int x = 0; x < result.width(); ++x) {
                    const float u =
                        (static_cast<float>(x) + 0.5f) / static_cast<float>(result.width());
                    const float v =
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(result.height());
                    // Lookups repeat, but the sky does not continue below the ground.
                    const glm::vec4 pixel =
                        sampleBilinear(picture, u, std::clamp(v, halfTexel, 1.0f - halfTexel));
                    const std::size_t at = 3 * (static_cast<std::size_t>(y) *
                                                    static_cast<std::size_t>(result.width()) +
                                                static_cast<std::size_t>(x));
                    for (int c = 0; c < 3; ++c)
                        texels[at + static_cast<std::size_t>(c)] = pixel[c];
                }
        });
    return result;
}

} // namespace

LayoutGuess guessLayout(const Image& image, const std::map<std::string, std::string>& attributes) {
    const int w = image.width(), h = image.height();
    if (const auto envmap = attributes.find("envmap"); envmap != attributes.end()) {
        if (envmap->second == "cube" && h == 6 * w)
            return {Layout::VerticalStrip, EnvironmentConvention::OpenExr};
        if (envmap->second == "latlong")
            return {Layout::LatLong, EnvironmentConvention::OpenExr};
    }
    if (w == 2 * h)
        return {Layout::LatLong};
    if (w == 6 * h)
        return {Layout::HorizontalStrip};
    if (h == 6 * w)
        return {Layout::VerticalStrip};
    if (w % 4 == 0 && 3 * w == 4 * h && hasEmptyCells(image, {4, 3}))
        return {Layout::HorizontalCross};
    if (w % 3 == 0 && 4 * w == 3 * h && hasEmptyCells(image, {3, 4}))
        return {Layout::VerticalCross};
    constexpr int kSmallestProbe = 16; // below, nothing is left of the corners
    if (w == h && w >= kSmallestProbe && hasBlackCorners(image))
        return {Layout::AngularMap};
    return {Layout::LatLong, EnvironmentConvention::Common, false};
}

std::vector<fs::path> sixFaceFiles(const fs::path& file) {
    const std::string stem = file.stem().string();
    const std::string lowered = lowerCase(stem);
    std::vector<fs::path> found;
    for (const auto& names : kFaceNames)
        for (const std::string_view name : names) {
            if (!lowered.ends_with(name))
                continue;
            const std::string before = stem.substr(0, stem.size() - name.size());
            // "apex.hdr" is no face: letters must not go on to the left of the name.
            const bool apart = before.empty() || name[0] == '+' || name[0] == '-' ||
                               std::isalpha(static_cast<unsigned char>(before.back())) == 0;
            if (!apart)
                continue;
            std::vector<fs::path> files;
            for (const std::string_view face : names) {
                fs::path path = file;
                path.replace_filename(before + inCaseOf(face, stem.substr(before.size())) +
                                      file.extension().string());
                files.push_back(std::move(path));
            }
            if (exist(files))
                return files;
            if (found.empty())
                found = std::move(files);
        }
    return found;
}

std::array<fs::path, 6> sixFaceOutputs(const fs::path& output) {
    std::array<fs::path, 6> files;
    for (std::size_t i = 0; i < 6; ++i) {
        files[i] = output;
        files[i].replace_filename(fmt::format("{}_{}{}", output.stem().string(), kFaceNames[0][i],
                                              output.extension().string()));
    }
    return files;
}

Result<EnvironmentPicture> readEnvironmentPicture(WorkerClient& worker, const fs::path& file,
                                                  EnvironmentLayout layout,
                                                  std::vector<Notice>& notices,
                                                  const JobContext& job) {
    Result<ReadImage> read = readImage(worker, file, kMaxEnvironmentSide);
    if (!read)
        return read.error();
    Image& image = read->image;

    // Six files
    const bool square = image.width() == image.height();
    if (layout == Layout::SixFaces || (layout == Layout::Automatic && square)) {
        const std::vector<fs::path> files = sixFaceFiles(file);
        if (layout == Layout::SixFaces && files.empty())
            return Error{ErrorKind::InputMissing,
                         "the names of six faces end in px nx py ny pz nz, in posx … or in right "
                         "left top bottom front back; rename the files, or choose another layout",
                         file,
                         {}};
        if (layout == Layout::SixFaces || exist(files)) {
            return readSixFaces(worker, file, files, *read, notices, job);
        }
    }

    // One file
    addNotices(*read, file, notices);
    EnvironmentConvention convention = EnvironmentConvention::Common;
    if (layout == Layout::Automatic) {
        const LayoutGuess guess = guessLayout(image, read->attributes);
        layout = guess.layout;
        convention = guess.convention;
        if (layout == Layout::AngularMap)
            notices.push_back({"this square picture with black corners was read as an angular map "
                               "(light probe); if it shows a mirror ball, choose that layout",
                               file});
    }
    if (layout == Layout::LatLong && image.width() != 2 * image.height() &&
        convention == EnvironmentConvention::Common)
        notices.push_back({fmt::format("the picture is {} × {} and not twice as wide as high, as a "
                                       "lat-long environment is; it was stretched",
                                       image.width(), image.height()),
                           file});
    return makePicture(std::move(image), layout, convention, file);
}

Image latLongOf(const EnvironmentPicture& picture, int maxWidth, const JobContext& job) {
    if (picture.mapping.isCommonLatLong()) {
        const ImageSize size = picture.mapping.size();
        if (size.width == 2 * size.height)
            return shrinkLatLong(picture.image, maxWidth);
        const int limit = maxWidth / (size.height > size.width ? 2 : 1);
        return stretched(shrinkImage(picture.image, limit));
    }
    const int width = std::min(picture.mapping.latLongSize().width, maxWidth);
    const Result<EnvironmentMapping> latLong = EnvironmentMapping::create(
        EnvironmentLayout::LatLong,
        EnvironmentMapping::imageSize(EnvironmentLayout::LatLong, width));
    return resampleEnvironment(picture.image, picture.mapping, *latLong, {}, job);
}

std::string_view layoutLabel(EnvironmentLayout layout) {
    return findParameter("environment.layout")->choiceLabels[static_cast<std::size_t>(layout)];
}

std::optional<EnvironmentLayout> layoutNamed(std::string_view name) {
    std::string wanted = lowerCase(name);
    std::erase(wanted, '-');
    const auto choices = findParameter("environment.layout")->choices;
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (lowerCase(choices[i]) == wanted)
            return static_cast<EnvironmentLayout>(i);
    return std::nullopt;
}

} // namespace patina

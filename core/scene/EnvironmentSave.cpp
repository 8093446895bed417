#include "core/scene/EnvironmentSave.h"

#include "core/base/Check.h"
#include "core/base/Limits.h"
#include "core/io/ImageIO.h"
#include "core/light/EnvironmentResample.h"
#include "core/scene/EnvironmentFile.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Layout = EnvironmentLayout;

Error refuse(std::string why, const fs::path& file) {
    return {ErrorKind::Usage, std::move(why), file, {}};
}

// Faces of the strip that six files are.
Image face(const Image& strip, std::size_t index) {
    Image image(strip.width(), strip.width(), 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> target = image.f32();
    std::ranges::copy(strip.f32().subspan(index * target.size(), target.size()), target.begin());
    return image;
}

Result<void> writeAll(const std::vector<fs::path>& files, const std::vector<Bytes>& contents) {
    std::vector<fs::path> created;
    for (std::size_t i = 0; i < files.size(); ++i) {
        std::error_code ignored;
        const bool isNew = !fs::exists(files[i], ignored);
        if (Result<void> written = writeFileAtomically(files[i], contents[i]); !written) {
            for (const fs::path& file : created)
                fs::remove(file, ignored);
            return written;
        }
        if (isNew)
            created.push_back(files[i]);
    }
    return {};
}

} // namespace

int environmentSaveSize(EnvironmentLayout layout, int latLongWidth) {
    switch (layout) {
    case Layout::LatLong:
    case Layout::AngularMap:
    case Layout::MirrorBall:
        return latLongWidth;
    default: { // a face's middle has N / 2 pixels per radian, a lat-long W / 2pi
        constexpr int kStep = 8;
        return std::max(1, (latLongWidth / 3 + kStep - 1) / kStep * kStep);
    }
    }
}

Result<std::vector<fs::path>> environmentOutputs(const EnvironmentSaveSettings& settings) {
    const fs::path& output = settings.output;
    CHECK(settings.layout != Layout::Automatic);
    const Result<ImageFileFormat> format = imageFormatForPath(output);
    if (!format || (*format != ImageFileFormat::Exr && *format != ImageFileFormat::Hdr))
        return refuse("environments are written as .exr or .hdr; choose one of these endings",
                      output);
    const bool mayEnvmap =
        settings.layout == Layout::LatLong || settings.layout == Layout::VerticalStrip;
    if (settings.openExrEnvmap && (*format != ImageFileFormat::Exr || !mayEnvmap))
        return refuse("OpenEXR's envmap attribute exists for .exr files of lat-longs and vertical "
                      "strips; choose one of them, or leave it out",
                      output);
    if (settings.size < 0 || (settings.layout == Layout::LatLong && settings.size % 2 != 0))
        return refuse("a lat-long is twice as wide as high; give it an even width", output);
    const ImageSize size = EnvironmentMapping::imageSize(settings.layout, settings.size);
    const double bytes = 12.0 * size.width * size.height;
    if (settings.size > limits::kMaxImageSide ||
        std::max(size.width, size.height) > limits::kMaxImageSide ||
        bytes > static_cast<double>(limits::kMaxImageBytes))
        return refuse(fmt::format("{} × {} pixels are too many; choose a smaller size", size.width,
                                  size.height),
                      output);
    if (settings.layout != Layout::SixFaces)
        return std::vector<fs::path>{output};
    const std::array<fs::path, 6> six = sixFaceOutputs(output);
    return std::vector<fs::path>(six.begin(), six.end());
}

Result<std::vector<fs::path>> saveEnvironment(WorkerClient& worker, const Environment& environment,
                                              const EnvironmentSaveSettings& settings,
                                              const JobContext& job) {
    const Result<std::vector<fs::path>> files = environmentOutputs(settings);
    if (!files)
        return files.error();
    CHECK(environment.image != nullptr);
    const Image& picture = *environment.image;
    const auto convention =
        settings.openExrEnvmap ? EnvironmentConvention::OpenExr : EnvironmentConvention::Common;
    const int size =
        settings.size > 0 ? settings.size : environmentSaveSize(settings.layout, picture.width());
    const Result<EnvironmentMapping> from =
        EnvironmentMapping::create(Layout::LatLong, {picture.width(), picture.height()});
    const Result<EnvironmentMapping> to = EnvironmentMapping::create(
        settings.layout, EnvironmentMapping::imageSize(settings.layout, size), convention);
    if (!from || !to)
        return from ? to.error() : from.error();

    job.setActivity("changing the layout");
    const Image image = resampleEnvironment(
        picture, *from, *to, {orientationOf(environment), std::exp2(environment.exposureEv)}, job);

    job.setActivity("encoding");
    std::vector<Bytes> contents;
    for (std::size_t i = 0; i < files->size(); ++i) {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "saving was cancelled", settings.output, {}};
        std::vector<ImagePart> parts(1);
        parts[0].image = files->size() > 1 ? face(image, i) : image;
        if (settings.openExrEnvmap)
            parts[0].attributes["envmap"] = settings.layout == Layout::LatLong ? "latlong" : "cube";
        Result<Bytes> bytes = encodeImage(worker, parts, *imageFormatForPath(settings.output));
        if (!bytes) {
            Error error = bytes.error();
            error.file = (*files)[i];
            return error;
        }
        contents.push_back(std::move(*bytes));
    }
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "saving was cancelled", settings.output, {}};
    if (Result<void> written = writeAll(*files, contents); !written)
        return written.error();
    return files;
}

} // namespace patina

#include "core/bracket/Bracket.h"

#include "core/bracket/PhotoSamples.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace patina {
namespace {

namespace fs = std::filesystem;

// Progress of the whole at the ends of its steps.
constexpr double kRead = 0.5, kAligned = 0.7, kRecovered = 0.75;

// A curve that is off by less is sRGB's: rounding of dark codes alone makes as much.
constexpr double kSrgbTolerance = 0.04;
// A response that rises by less between dark and bright codes was not recovered but invented.
constexpr double kLeastRise = 0.7; // natural logarithm: one stop

constexpr double kMostEv = 100.0;

Error usage(std::string message, const fs::path& file = {}) {
    return {ErrorKind::Usage, std::move(message), file, {}};
}

Error cancelledError() {
    return {ErrorKind::Cancelled, "merging the photos was cancelled", {}, {}};
}

std::string nameOf(const fs::path& file) {
    return file.filename().string();
}

// Decodes them, several at a time.
Result<std::vector<Photo>> readPhotos(WorkerClient& worker, std::span<const fs::path> files,
                                      const JobContext& job) {
    std::vector<std::optional<Result<LoadedImage>>> loaded(files.size());
    std::atomic<std::size_t> done = 0;
    parallelFor(job, files.size(), 1, [&](std::size_t begin, std::size_t) {
        ImageLoadOptions options;
        options.integerEncoding = ColorEncoding::Data; // codes
        options.colorOnly = true;
        loaded[begin] = loadImage(worker, files[begin], options, job);
        job.setProgress(static_cast<double>(++done) / static_cast<double>(files.size()));
    });
    if (job.cancelled())
        return cancelledError();
    std::vector<Photo> photos;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!*loaded[i])
            return loaded[i]->error();
        ImagePart& part = (*loaded[i])->parts.front();
        Photo photo;
        photo.file = files[i];
        photo.exposure = exposureOf(part.attributes);
        photo.image = std::move(part.image);
        photos.push_back(std::move(photo));
    }
    return photos;
}

// All as the first one is.
std::optional<Error> checkAlike(const std::vector<Photo>& photos) {
    const Image& first = photos.front().image;
    for (const Photo& photo : photos) {
        const Image& image = photo.image;
        if (image.width() != first.width() || image.height() != first.height())
            return usage(fmt::format("the photo has {} × {} pixels, {} has {} × {}; photos of a "
                                     "bracket have one size",
                                     image.width(), image.height(), nameOf(photos.front().file),
                                     first.width(), first.height()),
                         photo.file);
        if ((image.channels() < 3) != (first.channels() < 3))
            return usage("the photo is in greys and others are in colour, or the other way round",
                         photo.file);
        if ((image.type() == PixelType::F32) != (first.type() == PixelType::F32))
            return usage("the photo is linear (floating point) and others are not, or the other "
                         "way round",
                         photo.file);
    }
    return std::nullopt;
}

Result<void> setExposures(std::vector<Photo>& photos, std::span<const fs::path> files,
                          const BracketOptions& options) {
    std::vector<double> evs = options.exposuresEv;
    if (evs.empty()) {
        std::vector<PhotoExposure> exposures;
        for (const Photo& photo : photos)
            exposures.push_back(photo.exposure);
        Result<std::vector<double>> found = exposuresEv(files, exposures);
        if (!found)
            return found.error();
        evs = std::move(*found);
    }
    const auto isStated = [](double ev) { return std::abs(ev) <= kMostEv; }; // NaN is not
    if (!std::ranges::all_of(evs, isStated))
        return usage(fmt::format("exposures are numbers of stops from -{0} to {0}", kMostEv));
    const double mean =
        std::accumulate(evs.begin(), evs.end(), 0.0) / static_cast<double>(evs.size());
    for (std::size_t i = 0; i < photos.size(); ++i)
        photos[i].ev = evs[i] - mean;
    const auto [least, most] = std::minmax_element(evs.begin(), evs.end());
    if (*most - *least < kSameExposureEv)
        return usage("all photos have the same exposure; a bracket needs photos that are exposed "
                     "differently",
                     files.front());
    return {};
}

// Shares of white and black pixels, and the mean code.
struct PhotoStatistics {
    double white = 0.0, black = 0.0, mean = 0.0;
};

PhotoStatistics statisticsOf(const Photo& photo, const JobContext& job) {
    const auto channels = static_cast<std::size_t>(photo.image.channels());
    std::vector<float> row(static_cast<std::size_t>(photo.image.width()) * channels);
    std::size_t white = 0, black = 0;
    double sum = 0.0;
    for (int y = 0; y < photo.image.height() && !job.cancelled(); ++y) {
        codesOfRow(photo, y, row);
        for (std::size_t x = 0; x < row.size(); x += channels) {
            const auto [least, most] =
                std::minmax_element(row.begin() + static_cast<std::ptrdiff_t>(x),
                                    row.begin() + static_cast<std::ptrdiff_t>(x + channels));
            white += *most >= kTopCode ? 1 : 0;
            black += *least <= 0.0f ? 1 : 0;
            sum += std::accumulate(row.begin() + static_cast<std::ptrdiff_t>(x),
                                   row.begin() + static_cast<std::ptrdiff_t>(x + channels), 0.0);
        }
    }
    const double pixels =
        static_cast<double>(photo.image.width()) * static_cast<double>(photo.image.height());
    return {static_cast<double>(white) / pixels, static_cast<double>(black) / pixels,
            sum / (pixels * static_cast<double>(channels))};
}

void describePhotos(const std::vector<Photo>& photos, BracketReport& report,
                    const JobContext& job) {
    std::vector<PhotoStatistics> statistics(photos.size());
    parallelFor(job, photos.size(), 1, [&](std::size_t begin, std::size_t) {
        statistics[begin] = statisticsOf(photos[begin], job);
    });
    // A picture that is darker by less may be so by noise, or by clouds.
    constexpr double kDarker = 2.0; // codes
    for (std::size_t i = 0; i < photos.size(); ++i) {
        const Photo& photo = photos[i];
        report.photos.push_back(
            {photo.file, photo.exposure, photo.ev, {}, statistics[i].white, statistics[i].black});
        if (i == 0)
            continue;
        const Photo& before = photos[i - 1];
        if (photo.ev - before.ev < kSameExposureEv)
            report.warnings.push_back(fmt::format("{} and {} have the same exposure; their mean is "
                                                  "taken",
                                                  nameOf(before.file), nameOf(photo.file)));
        else if (!photo.isLinear() && statistics[i].mean + kDarker < statistics[i - 1].mean)
            report.warnings.push_back(
                fmt::format("{} is darker than {}, although its exposure is {:.1f} EV more; check "
                            "the exposures",
                            nameOf(photo.file), nameOf(before.file), photo.ev - before.ev));
    }
}

void align(std::vector<Photo>& photos, BracketReport& report, const JobContext& job) {
    const std::vector<PhotoShift> shifts = findShifts(photos, job);
    for (std::size_t i = 0; i < photos.size(); ++i) {
        photos[i].shift = report.photos[i].shift = shifts[i];
        if (std::max(std::abs(shifts[i].dx), std::abs(shifts[i].dy)) >= kMaxPhotoShift)
            report.warnings.push_back(
                fmt::format("{} is shifted by {} pixels or more, which is as far as is searched; "
                            "align the photos first",
                            nameOf(photos[i].file), kMaxPhotoShift));
    }
}

// The response of each channel, or sRGB's where that is it or nothing can be found.
std::vector<RecoveredResponse> recoverAll(const std::vector<Photo>& photos, BracketReport& report,
                                          const JobContext& job) {
    std::vector<RecoveredResponse> responses;
    const auto channels = static_cast<std::size_t>(photos.front().image.channels());
    if (photos.front().isLinear()) {
        report.response = ResponseKind::Linear;
        return std::vector<RecoveredResponse>(channels, {linearResponse(), kLeastNoise});
    }
    const LogResponse srgb = srgbResponse();
    for (const std::vector<ResponseSample>& samples : chooseSamples(photos, job)) {
        if (job.cancelled())
            return {};
        RecoveredResponse found{srgb, kLeastNoise};
        if (samples.size() >= kLeastSamples)
            found = recoverResponse(samples);
        const bool rises = found.curve[kCodes - 16] - found.curve[16] > kLeastRise;
        if (samples.size() < kLeastSamples || !rises) {
            report.response = ResponseKind::Assumed;
            found = {srgb, kLeastNoise};
        }
        report.srgbDifference =
            std::max(report.srgbDifference, responseDifference(found.curve, srgb));
        report.noiseCodes = std::max(report.noiseCodes, found.noiseCodes);
        responses.push_back(found);
    }
    if (report.response == ResponseKind::Assumed)
        report.warnings.emplace_back(
            "the response of the camera cannot be found: hardly anything is neither black nor "
            "white in two photos; the sRGB curve is assumed");
    else if (report.srgbDifference <= kSrgbTolerance)
        report.response = ResponseKind::Srgb;
    for (RecoveredResponse& response : responses) {
        // Of one channel that failed, and the others that did not, no colour would be right.
        if (report.response != ResponseKind::Recovered)
            response.curve = srgb;
        report.curves.push_back(response.curve);
    }
    return responses;
}

} // namespace

Result<Bracket> makeBracket(WorkerClient& worker, std::span<const fs::path> files,
                            const BracketOptions& options, const JobContext& job) {
    if (files.size() < 2)
        return usage("a bracket needs two photos or more, exposed differently",
                     files.empty() ? fs::path() : files.front());
    if (files.size() > kMaxPhotos)
        return usage(fmt::format("a bracket has at most {} photos", kMaxPhotos));
    if (!options.exposuresEv.empty() && options.exposuresEv.size() != files.size())
        return usage(fmt::format("{} exposures were given for {} photos",
                                 options.exposuresEv.size(), files.size()));

    job.setActivity("reading photos");
    Result<std::vector<Photo>> read = readPhotos(worker, files, job.part(0.0, kRead));
    if (!read)
        return read.error();
    std::vector<Photo>& photos = *read;
    if (std::optional<Error> differ = checkAlike(photos))
        return *differ;
    if (Result<void> exposures = setExposures(photos, files, options); !exposures)
        return exposures.error();
    for (Photo& photo : photos)
        if (photo.isLinear())
            photo.white = whiteOf(photo.image);
    std::stable_sort(photos.begin(), photos.end(),
                     [](const Photo& a, const Photo& b) { return a.ev < b.ev; });

    Bracket bracket;
    BracketReport& report = bracket.report;
    describePhotos(photos, report, job);
    if (options.align) {
        job.setActivity("aligning photos");
        align(photos, report, job.part(kRead, kAligned));
    }
    if (job.cancelled())
        return cancelledError();
    job.setActivity("recovering the response");
    const std::vector<RecoveredResponse> responses = recoverAll(photos, report, job);
    if (job.cancelled())
        return cancelledError();
    job.setActivity("merging photos");
    bracket.merged = mergePhotos(photos, responses, job.part(kRecovered, 1.0));
    if (job.cancelled())
        return cancelledError();
    const std::vector<std::uint8_t>& marks = bracket.merged.marks;
    report.clippedAbove = shareOf(marks, kClippedAbove);
    report.clippedBelow = shareOf(marks, kClippedBelow);
    report.disagreeing = shareOf(marks, kDisagrees);
    return bracket;
}

std::string_view responseText(ResponseKind kind) {
    switch (kind) {
    case ResponseKind::Recovered:
        return "recovered from the photos";
    case ResponseKind::Srgb:
        return "sRGB";
    case ResponseKind::Assumed:
        return "sRGB, assumed";
    case ResponseKind::Linear:
        return "linear";
    }
    return {};
}

} // namespace patina

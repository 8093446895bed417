#include "core/compare/Flip.h"

#include "core/base/Check.h"
#include "core/compare/Comparable.h"
#include "core/compare/FlipTile.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace patina {
namespace {

using compare::FlipKernels;
using compare::FlipRow;
using compare::FlipTile;
using compare::TileRect;

bool isHdr(const Image& image) {
    return image.type() == PixelType::F32 && image.encoding() != ColorEncoding::Srgb;
}

Image emptyMap(const Image& image) {
    return {image.width(), image.height(), 1, PixelType::F32, ColorEncoding::Data};
}

// Calls body(tile, rect) for all tiles of the two pictures, after tile.read(rect).
Result<void> forEachTile(const Image& image, const Image& reference, const FlipKernels& kernels,
                         const JobContext& job,
                         const std::function<void(FlipTile&, const TileRect&)>& body) {
    constexpr int kSide = FlipTile::kSide;
    const int columns = (image.width() + kSide - 1) / kSide;
    const auto count = static_cast<std::size_t>(columns) *
                       static_cast<std::size_t>((image.height() + kSide - 1) / kSide);
    std::atomic<std::size_t> done = 0;
    parallelFor(job, count, 1, [&](std::size_t begin, std::size_t end) {
        FlipTile tile(image, reference, kernels);
        for (std::size_t i = begin; i < end; ++i) {
            const int x = static_cast<int>(i) % columns * kSide;
            const int y = static_cast<int>(i) / columns * kSide;
            const TileRect rect{x, y, std::min(kSide, image.width() - x),
                                std::min(kSide, image.height() - y)};
            tile.read(rect);
            body(tile, rect);
            job.setProgress(static_cast<double>(++done) / static_cast<double>(count));
        }
    });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

} // namespace

Result<Flip> computeFlip(const Image& image, const Image& reference, const JobContext& job,
                         const FlipSettings& settings) {
    CHECK(settings.pixelsPerDegree >= 1.0 && settings.pixelsPerDegree <= 400.0);
    if (Result<void> comparable = compare::checkPictures(image, reference); !comparable)
        return comparable.error();

    Flip flip;
    std::vector<float> exposures;
    if (isHdr(image) || isHdr(reference)) {
        flip.exposures = settings.exposures ? *settings.exposures : flipExposures(reference);
        const auto& [start, stop, count] = *flip.exposures;
        for (int i = 0; i < count; ++i)
            exposures.push_back(
                static_cast<float>(count > 1 ? start + (stop - start) * i / (count - 1) : start));
    }

    flip.error.values = emptyMap(image);
    const std::span<float> out = flip.error.values.f32();
    const FlipKernels kernels(settings.pixelsPerDegree);
    const auto body = [&](FlipTile& tile, const TileRect& rect) {
        const auto keepLarger = [&](int y, const FlipRow& row) {
            const std::size_t first =
                static_cast<std::size_t>(rect.y + y) * static_cast<std::size_t>(image.width()) +
                static_cast<std::size_t>(rect.x);
            for (std::size_t x = 0; x < row.color.size(); ++x)
                out[first + x] = std::max(
                    out[first + x], compare::flipError(row.color[x], row.edge[x], row.point[x]));
        };
        if (!flip.exposures)
            return tile.evaluate(nullptr, keepLarger);
        for (const float exposure : exposures) {
            if (job.cancelled()) // a tile at all exposures may take a second
                return;
            tile.evaluate(&exposure, keepLarger);
        }
    };
    if (Result<void> done = forEachTile(image, reference, kernels, job, body); !done)
        return done.error();
    flip.error.summary = summarize(flip.error.values);
    return flip;
}

Result<FlipTerms> computeFlipTerms(const Image& image, const Image& reference,
                                   const JobContext& job, double pixelsPerDegree) {
    CHECK(pixelsPerDegree >= 1.0 && pixelsPerDegree <= 400.0);
    if (Result<void> comparable = compare::checkPictures(image, reference); !comparable)
        return comparable.error();
    FlipTerms terms{emptyMap(image), emptyMap(image), emptyMap(image)};
    const std::span<float> color = terms.color.f32(), edge = terms.edge.f32(),
                           point = terms.point.f32();
    const FlipKernels kernels(pixelsPerDegree);
    const auto body = [&](FlipTile& tile, const TileRect& rect) {
        tile.evaluate(nullptr, [&](int y, const FlipRow& row) {
            const std::size_t first =
                static_cast<std::size_t>(rect.y + y) * static_cast<std::size_t>(image.width()) +
                static_cast<std::size_t>(rect.x);
            std::ranges::copy(row.color, color.begin() + static_cast<std::ptrdiff_t>(first));
            std::ranges::copy(row.edge, edge.begin() + static_cast<std::ptrdiff_t>(first));
            std::ranges::copy(row.point, point.begin() + static_cast<std::ptrdiff_t>(first));
        });
    };
    if (Result<void> done = forEachTile(image, reference, kernels, job, body); !done)
        return done.error();
    return terms;
}

} // namespace patina

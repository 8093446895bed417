#include "core/compare/FlipAgainst.h"

#include "core/base/Check.h"
#include "core/compare/Comparable.h"
#include "core/compare/Flip.h"
#include "core/compare/FlipTile.h"

#include <algorithm>
#include <vector>

namespace patina {

struct FlipAgainst::Impl {
    Image reference;
    compare::FlipKernels kernels{kFlipPixelsPerDegree};
    struct Part {
        compare::TileRect rect;
        compare::FlipFeatures features;
    };
    std::vector<Part> parts;
};

struct FlipAgainst::Worker::Impl {
    explicit Impl(const FlipAgainst::Impl& against)
        : against(against)
        , tile(against.reference, against.reference, against.kernels) {}
    const FlipAgainst::Impl& against;
    compare::FlipTile tile;
};

FlipAgainst::FlipAgainst(std::unique_ptr<Impl> impl)
    : m_impl(std::move(impl)) {}
FlipAgainst::FlipAgainst(FlipAgainst&&) noexcept = default;
FlipAgainst& FlipAgainst::operator=(FlipAgainst&&) noexcept = default;
FlipAgainst::~FlipAgainst() = default;

Result<FlipAgainst> FlipAgainst::create(const Image& reference) {
    if (Result<void> fine = compare::checkPictures(reference, reference); !fine)
        return fine.error();
    auto impl = std::make_unique<Impl>();
    impl->reference = reference;
    compare::FlipTile tile(impl->reference, impl->reference, impl->kernels);
    constexpr int kSide = compare::FlipTile::kSide;
    for (int y = 0; y < reference.height(); y += kSide)
        for (int x = 0; x < reference.width(); x += kSide) {
            Impl::Part& part = impl->parts.emplace_back();
            part.rect = {x, y, std::min(kSide, reference.width() - x),
                         std::min(kSide, reference.height() - y)};
            part.features = tile.features(impl->reference, part.rect);
        }
    return FlipAgainst(std::move(impl));
}

FlipAgainst::Worker::Worker(const FlipAgainst& reference)
    : m_impl(std::make_unique<Impl>(*reference.m_impl)) {}
FlipAgainst::Worker::Worker(Worker&&) noexcept = default;
FlipAgainst::Worker& FlipAgainst::Worker::operator=(Worker&&) noexcept = default;
FlipAgainst::Worker::~Worker() = default;

void FlipAgainst::Worker::compare(const Image& image, std::span<float> errors) {
    const Image& reference = m_impl->against.reference;
    CHECK(image.width() == reference.width());
    CHECK(image.height() == reference.height());
    const auto width = static_cast<std::size_t>(image.width());
    CHECK(errors.size() == width * static_cast<std::size_t>(image.height()));
    for (const FlipAgainst::Impl::Part& part : m_impl->against.parts)
        m_impl->tile.evaluateAgainst(
            part.features, image, part.rect, [&](int y, const patina::compare::FlipRow& row) {
                float* out = errors.data() + static_cast<std::size_t>(part.rect.y + y) * width +
                             static_cast<std::size_t>(part.rect.x);
                for (std::size_t x = 0; x < row.color.size(); ++x)
                    out[x] = patina::compare::flipError(row.color[x], row.edge[x], row.point[x]);
            });
}

} // namespace patina

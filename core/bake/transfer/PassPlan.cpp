#include "core/bake/transfer/PassPlan.h"

#include "core/bake/transfer/Refinement.h"
#include "core/base/Check.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr int kFirstPass = 32;

} // namespace

PassSchedule::PassSchedule(const PassSettings& settings)
    : m_method(settings.method)
    , m_first(settings.method == SampleMethod::Stratified
                  ? settings.samples
                  : std::min(kFirstPass, settings.samples)) {
    for (int n = m_first; n < settings.samples; n *= 2)
        ++m_passes;
}

PassPlan::PassPlan(std::span<const BakePoint> points, std::span<const PointRange> ranges,
                   const PassSettings& settings, PassState& state)
    : m_ranges(ranges)
    , m_settings(settings)
    , m_state(state)
    , m_schedule(settings) {
    if (settings.tolerance > 0.0f)
        m_tiles.emplace(points, settings.seed);
    const auto stride = static_cast<std::size_t>(settings.stride());
    const std::size_t count = points.size();
    if (state.passes.empty()) {
        state.values.resize(count * stride);
        if (settings.shOrder > 0)
            state.hiddenSky.resize(count);
        state.error.resize(count);
        state.passes.resize(count);
        state.wanted.resize(count);
    }
    CHECK_EQ(state.values.size(), count * stride);
    CHECK_EQ(state.hiddenSky.size(), settings.shOrder > 0 ? count : 0);
    CHECK_EQ(state.error.size(), count);
    CHECK_EQ(state.passes.size(), count);
    CHECK_EQ(state.wanted.size(), count);
    updateSamplesDone(); // a state may be kept before the end of its last pass was noticed
}

std::size_t PassPlan::raysKnown() const {
    std::size_t rays = 0;
    forPoints([&](std::size_t p) {
        rays += static_cast<std::size_t>(m_schedule.raysAfter(m_state.passes[p]));
    });
    return rays;
}

double PassPlan::allRays() const {
    std::size_t held = 0;
    forPoints([&](std::size_t) { ++held; });
    return static_cast<double>(m_settings.samples) *
           static_cast<double>(std::max<std::size_t>(held, 1));
}

bool PassPlan::pending() const {
    bool some = false;
    forPoints([&](std::size_t p) { some = some || m_state.passes[p] < m_state.wanted[p]; });
    return some;
}

bool PassPlan::wantMore() {
    bool some = false;
    const auto want = [&](std::size_t p) {
        if (m_state.passes[p] >= m_schedule.passes())
            return;
        ++m_state.wanted[p];
        some = true;
    };
    // The first two passes tell the error.
    if (!m_tiles || m_state.samplesDone < m_schedule.raysAfter(kPassesEverywhere)) {
        forPoints(want);
        return some;
    }
    // RMS over the tile: one point's estimate rests on too few numbers, and a point that
    // happens to see nothing of a light that its neighbours see would believe itself right.
    std::vector<PointError> known(m_state.passes.size());
    for (std::size_t t = 0; t < m_tiles->count(); ++t) {
        const std::span<const std::uint32_t> tile = m_tiles->points(t);
        float squares = 0.0f;
        for (const std::uint32_t p : tile)
            squares += m_state.error[p] * m_state.error[p];
        const float error = std::sqrt(squares / static_cast<float>(tile.size()));
        for (const std::uint32_t p : tile)
            known[p] = {error, m_schedule.raysAfter(m_state.passes[p])};
    }
    const std::vector<std::uint8_t> refine =
        pointsToRefine(known, m_settings.tolerance, m_settings.samples);
    for (std::size_t p = 0; p < refine.size(); ++p)
        if (refine[p] != 0)
            want(p);
    return some;
}

void PassPlan::updateSamplesDone() {
    int least = m_schedule.passes();
    forPoints([&](std::size_t p) { least = std::min<int>(least, m_state.passes[p]); });
    m_state.samplesDone = m_schedule.raysAfter(least);
}

std::vector<PassBatch> PassPlan::batches() const {
    std::vector<bool> needed(static_cast<std::size_t>(m_schedule.passes()));
    forPoints([&](std::size_t p) {
        if (m_state.passes[p] < m_state.wanted[p])
            needed[m_state.passes[p]] = true;
    });
    std::vector<PassBatch> result;
    const auto add = [&](int pass, bool second, int first, int end) {
        result.push_back(
            {pass, second,
             HemisphereSamples(m_settings.seed, static_cast<std::uint32_t>(first),
                               static_cast<std::uint32_t>(end - first), m_settings.method)});
    };
    for (int pass = 0; pass < m_schedule.passes(); ++pass) {
        if (!needed[static_cast<std::size_t>(pass)])
            continue;
        const int first = m_schedule.raysAfter(pass), end = m_schedule.raysAfter(pass + 1);
        if (pass == 0 && m_schedule.halvesFirst()) {
            add(pass, false, 0, end / 2);
            add(pass, true, end / 2, end);
        } else {
            add(pass, pass > 0, first, end);
        }
    }
    return result;
}

} // namespace patina

// What the passes of a bake are to do: how many rays each takes, which points want another one, and
// when the bake is done. Decided from the state alone, so that it does not matter who traced what.
#pragma once

#include "core/bake/domain/HemisphereSamples.h"
#include "core/bake/transfer/Passes.h"
#include "core/bake/transfer/VisibilityTiles.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// To a tolerance, the passes after those that go everywhere cast rays only where the neighbours of
// a tile differ (core/bake/transfer/TileTracer.h).
inline constexpr int kPassesEverywhere = 2;

// How many rays the passes take.
class PassSchedule {
  public:
    explicit PassSchedule(const PassSettings& settings);

    [[nodiscard]] int passes() const { return m_passes; }
    [[nodiscard]] int raysAfter(int passes) const {
        return passes == 0 ? 0 : m_first << (passes - 1);
    }
    // A pass that is the only one is halved, so that its error can be told.
    [[nodiscard]] bool halvesFirst() const {
        return m_passes == 1 && m_method != SampleMethod::Stratified && m_first > 1;
    }

  private:
    SampleMethod m_method;
    int m_first;
    int m_passes = 1;
};

// Rays of one batch for the points that need it.
struct PassBatch {
    int pass;    // the points' pass that it belongs to
    bool second; // the second half of the first pass, or all of a later one
    HemisphereSamples samples;
};

// Of the points of one shard. Refers to what it is made with.
class PassPlan {
  public:
    // Makes room in a state that is empty; one that is not must be of the same points.
    PassPlan(std::span<const BakePoint> points, std::span<const PointRange> ranges,
             const PassSettings& settings, PassState& state);

    [[nodiscard]] const PassSchedule& schedule() const { return m_schedule; }
    // The tiles of a bake to a tolerance, else null.
    [[nodiscard]] const VisibilityTiles* tiles() const { return m_tiles ? &*m_tiles : nullptr; }

    // Some points have not had all the passes that were decided on.
    [[nodiscard]] bool pending() const;
    // Decides on one more pass; false when the bake is done.
    [[nodiscard]] bool wantMore();
    // What the points that want more need, earlier passes first.
    [[nodiscard]] std::vector<PassBatch> batches() const;
    // Sets PassState::samplesDone.
    void updateSamplesDone();

    // Rays known by now, and when every point of the shard has had them all.
    [[nodiscard]] std::size_t raysKnown() const;
    [[nodiscard]] double allRays() const;

  private:
    // Calls f(point) for the points of this shard.
    template <typename F>
    void forPoints(F f) const {
        for (std::size_t r = 0; r < m_ranges.size(); ++r)
            if (m_settings.shard.holds(r))
                for (std::size_t p = 0; p < m_ranges[r].count; ++p)
                    f(m_ranges[r].first + p);
    }

    std::span<const PointRange> m_ranges;
    const PassSettings& m_settings;
    PassState& m_state;
    PassSchedule m_schedule;
    std::optional<VisibilityTiles> m_tiles;
};

} // namespace patina

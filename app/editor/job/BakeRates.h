// How fast this machine bakes, by kind: rays of the estimate over the seconds of a whole bake, so
// that what casts no rays (bounces that are followed, values that are fitted) counts as well.
// Remembered over sessions.
#pragma once

#include "core/bake/domain/BakeRequest.h"

#include <QString>

namespace patina {
struct JobProgress;
}

namespace patina::editor {

class BakeRates {
  public:
    // `rays`: of estimateBake(). Before a bake of the kind has ended it is a guess.
    [[nodiscard]] static double seconds(const BakeRequest& request, double rays);
    // Of a bake that has come to its end. One that was found or resumed has cast few of its rays,
    // and one of a moment has mostly prepared: these tell nothing.
    static void learn(const BakeRequest& request, double rays, const JobProgress& whole);

  private:
    [[nodiscard]] static QString key(const BakeRequest& request);
};

} // namespace patina::editor

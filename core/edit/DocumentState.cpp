#include "core/edit/DocumentState.h"

#include <algorithm>

namespace patina {
namespace {

// What a bake was made from decides its values, so that these need no look.
bool sameBake(const BakeArtifactPtr& a, const BakeArtifactPtr& b) {
    return a == b || (a->kind == b->kind && a->inputs == b->inputs && a->albedo == b->albedo &&
                      a->settings == b->settings && a->order == b->order &&
                      a->transfer == b->transfer && a->bounces == b->bounces &&
                      a->samplesDone == b->samplesDone && a->missingFile == b->missingFile);
}

} // namespace

bool operator==(const DocumentState& a, const DocumentState& b) {
    return a.history == b.history && a.step == b.step &&
           std::ranges::equal(a.bakes, b.bakes, sameBake);
}

} // namespace patina

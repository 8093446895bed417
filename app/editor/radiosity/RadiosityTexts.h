// A radiosity solution in words.
#pragma once

#include "core/radiosity/document/EnergyFlow.h"

#include <QString>

namespace patina {
struct Document;
}

namespace patina::editor {

class RadiosityUpdater;

// "3 839 elements · residual 0.08 % · 0.26 s", or what stands in the way.
[[nodiscard]] QString radiosityStatus(const RadiosityUpdater& radiosity);
// Whether light was gathered over links between clusters, and there are no rows of form factors.
[[nodiscard]] bool isByLinks(const LiveRadiosity& live);
// Of a solution that is shown without: why there are no form factors, or no links; else empty.
[[nodiscard]] QString missingFactorsText(const RadiosityUpdater& radiosity);
// As plots name it: short.
[[nodiscard]] QString solverName(radiosity::Solver solver);
// Everything of the solution, a line each.
[[nodiscard]] QString radiosityHelp(const LiveRadiosity& live);
// "After 12 shots · unshot 34 % · absorbed 51 %, escaped 15 % · next: Floor, element 1 204".
[[nodiscard]] QString stepStatus(const Document& document, const RadiosityUpdater& radiosity);
// "Key light", "Sky", "Glowing surfaces".
[[nodiscard]] QString sourceTitle(const Document& document, const RadiositySource& source);
// "Red wall", "Key light", "Sky", "Leaves the scene".
[[nodiscard]] QString flowName(const Document& document, const FlowShare& share);
// "Floor · element 1 204 · 25 cm²".
[[nodiscard]] QString elementName(const Document& document, const LiveRadiosity& live,
                                  std::uint32_t element);
// Of what shoots: as elementName(), or "Floor · patch 120 of 16 elements · 400 cm²".
[[nodiscard]] QString senderName(const Document& document, const LiveRadiosity& live,
                                 std::uint32_t sender);
// "12.4 %".
[[nodiscard]] QString flowPercent(double share);
// W/m², red, green and blue.
[[nodiscard]] QString fluxText(const glm::dvec3& light);

} // namespace patina::editor

// The energy of a material in words: what is lost, what compensation gives back, what is
// impossible.
#pragma once

#include "core/light/EnergyStudy.h"

#include <QString>
#include <QStringList>

namespace patina::editor {

enum class EnergyChannel { Luminance, Red, Green, Blue };

[[nodiscard]] double channelOf(const glm::dvec3& rgb, EnergyChannel channel);
// The same with one channel, or the luminance, in place of all three.
[[nodiscard]] Returned inChannel(const Returned& returned, EnergyChannel channel);

[[nodiscard]] QString percent(double share, int decimals = 1); // "31.4 %"

// "The specular lobe loses 44.8 % at roughness 0.90, 53.1 % at 0°: turn on compensation to get it
// back."
[[nodiscard]] QString lossText(const EnergyStudy& study, EnergyChannel channel);
// Whether compensation would be seen: it changes the specular lobe by half a percent or more.
[[nodiscard]] bool compensationMatters(const EnergyStudy& study, EnergyChannel channel);
// "All in all 61.2 % … ; 88.1 % with compensation."
[[nodiscard]] QString returnText(const EnergyStudy& study, EnergyChannel channel);

// What helps against a fault.
enum class EnergyFix { None, TurnOnCompensation, UseSmith };
[[nodiscard]] EnergyFix fixOf(const EnergyFault& fault, const ShadingModel& model);
[[nodiscard]] QString faultText(const EnergyFault& fault, const ShadingModel& model);

} // namespace patina::editor

#include "app/editor/panel/EnergyTexts.h"

#include "core/math/Shading.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kSeen = 0.005; // less than this of a lobe nobody sees
constexpr double kEqual = 5e-4; // what the quadratures err

QString trEnergy(const char* text) {
    return QCoreApplication::translate("EnergyTexts", text);
}

QString number(double value, int decimals = 2) {
    return QString::number(value, 'f', decimals);
}

QString angle(float NoV) {
    return trEnergy("%1°").arg(qRound(glm::degrees(std::acos(std::clamp(NoV, 0.0f, 1.0f)))));
}

double lossOf(const EnergyPoint& point, EnergyChannel channel) {
    return specularLoss(inChannel(point.single, channel), inChannel(point.compensated, channel)).x;
}

// "roughness 0.75, 37.3 % at 0°": where the lobe lies, and the angle at which it loses most; of a
// map also what its roughest texels lose.
QString place(const EnergyStudy& study, EnergyChannel channel) {
    const SurfaceRange& surface = study.surface;
    std::size_t at = 0;
    for (std::size_t i = 1; i < study.byAngle.size(); ++i)
        if (lossOf(study.byAngle[i], channel) > lossOf(study.byAngle[at], channel) + kEqual)
            at = i;
    QString text = trEnergy("roughness %1, %2 at %3°")
                       .arg(number(surface.mean.perceptualRoughness),
                            percent(lossOf(study.byAngle[at], channel)))
                       .arg(90 * static_cast<int>(at) / (EnergyStudy::kAngles - 1));
    if (surface.high.perceptualRoughness > surface.mean.perceptualRoughness)
        text += trEnergy(", and %1 where its map is roughest (%2)")
                    .arg(percent(lossOf(study.roughest, channel)),
                         number(surface.high.perceptualRoughness));
    return text;
}

// " in red"; nothing when all channels are alike.
QString inWhich(std::optional<int> channel) {
    if (!channel)
        return {};
    return *channel == 0   ? trEnergy(" in red")
           : *channel == 1 ? trEnergy(" in green")
                           : trEnergy(" in blue");
}

bool madeByBlinnPhong(const ShadingModel& model) {
    return model.distribution == Distribution::BlinnPhong && !model.multiScatter &&
           (model.visibility == Visibility::SmithCorrelated ||
            model.visibility == Visibility::SmithSeparable);
}

} // namespace

double channelOf(const glm::dvec3& rgb, EnergyChannel channel) {
    if (channel == EnergyChannel::Luminance)
        return shading::luminance(glm::vec3(rgb));
    return rgb[static_cast<int>(channel) - 1];
}

Returned inChannel(const Returned& returned, EnergyChannel channel) {
    return {glm::dvec3(channelOf(returned.specular, channel)),
            glm::dvec3(channelOf(returned.diffuse, channel))};
}

QString percent(double share, int decimals) {
    return trEnergy("%1 %").arg(100.0 * share, 0, 'f', decimals);
}

bool compensationMatters(const EnergyStudy& study, EnergyChannel channel) {
    return std::max(std::abs(lossOf(study.average, channel)),
                    std::abs(lossOf(study.roughest, channel))) >= kSeen;
}

QString lossText(const EnergyStudy& study, EnergyChannel channel) {
    const double loss = lossOf(study.average, channel);
    if (!compensationMatters(study, channel))
        return trEnergy(
                   "The specular lobe loses next to nothing at roughness %1: facets this even hide "
                   "little from each other.")
            .arg(number(study.surface.mean.perceptualRoughness));
    const bool on = study.model.multiScatter;
    if (loss < 0.0)
        return (on ? trEnergy("Compensation takes away the %1 that the specular lobe would have "
                              "too much "
                              "at roughness %2.")
                   : trEnergy("The specular lobe returns %1 too much at roughness %2: turn on "
                              "compensation to take it away."))
            .arg(percent(-loss), number(study.surface.mean.perceptualRoughness));
    return (on ? trEnergy("Compensation gives back the %1 that the specular lobe would lose at %2.")
               : trEnergy("The specular lobe loses %1 at %2: turn on compensation to get it back."))
        .arg(percent(loss), place(study, channel));
}

QString returnText(const EnergyStudy& study, EnergyChannel channel) {
    const double single = channelOf(study.average.single.total(), channel);
    const double whole = channelOf(study.average.compensated.total(), channel);
    const bool on = study.model.multiScatter;
    if (std::abs(single - whole) < 0.0005)
        return trEnergy("All in all the material returns %1 of the light, seen from all sides.")
            .arg(percent(on ? whole : single));
    return on ? trEnergy("All in all the material returns %1 of the light, seen from all sides; %2 "
                         "without compensation.")
                    .arg(percent(whole), percent(single))
              : trEnergy(
                    "All in all the material returns %1 of the light, seen from all sides; %2 with "
                    "compensation.")
                    .arg(percent(single), percent(whole));
}

EnergyFix fixOf(const EnergyFault& fault, const ShadingModel& model) {
    if (fault.kind == EnergyFault::Kind::MakesLight && madeByBlinnPhong(model))
        return EnergyFix::TurnOnCompensation;
    if (fault.kind == EnergyFault::Kind::LightsDiffer &&
        model.visibility == Visibility::SchlickDirect)
        return EnergyFix::UseSmith;
    return EnergyFix::None;
}

QString faultText(const EnergyFault& fault, const ShadingModel& model) {
    const QString where =
        trEnergy("at %1 and roughness %2").arg(angle(fault.NoV), number(fault.perceptualRoughness));
    const QString channel = inWhich(fault.channel);
    switch (fault.kind) {
    case EnergyFault::Kind::MakesLight: {
        const QString made = trEnergy("Makes light: %1 of what lights send comes back%2, %3.")
                                 .arg(percent(fault.value), channel, where);
        if (madeByBlinnPhong(model))
            return made + QLatin1Char(' ') +
                   trEnergy(
                       "Blinn-Phong borrows its visibility; compensation takes the excess away.");
        if (model.fresnel == Fresnel::Dielectric)
            return made + QLatin1Char(' ') +
                   trEnergy("The layer over the body is weighed by its reflectance at one angle; "
                            "no real "
                            "surface is that white.");
        return made;
    }
    case EnergyFault::Kind::LightsDiffer: {
        const QString differ =
            (fault.value < 0.0 ? trEnergy("Lights return %1 less than the environment does%2, %3.")
                               : trEnergy("Lights return %1 more than the environment does%2, %3."))
                .arg(percent(std::abs(fault.value)), channel, where);
        if (model.visibility == Visibility::SchlickDirect)
            return differ + QLatin1Char(' ') +
                   trEnergy("Schlick's k = (r + 1)²/8 was made for lights only.");
        return differ;
    }
    default:
        return trEnergy("The base colour reaches %1%2, more than all light. It is cut at 1.")
            .arg(number(fault.value), channel);
    }
}

} // namespace patina::editor

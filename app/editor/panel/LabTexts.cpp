#include "app/editor/panel/LabTexts.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

QString trLab(const char* text) {
    return QCoreApplication::translate("LightLab", text);
}

// 81.49, 3.210, 0.04300: neighbours can be compared, for the last digits do not come and go.
QString fourDigits(double value) {
    const double order = value > 0.0 ? std::floor(std::log10(value)) : 0.0;
    return labFixed(value, static_cast<int>(std::clamp(3.0 - order, 0.0, 8.0)));
}

} // namespace

QString labNumber(double value) {
    return QString::number(value, 'g', 3).replace(QLatin1Char('-'), QStringLiteral("−"));
}

QString labFixed(double value, int decimals) {
    return QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QStringLiteral("−"));
}

QString labColor(const glm::vec3& c) {
    return QStringLiteral("%1  %2  %3")
        .arg(labNumber(static_cast<double>(c.x)), labNumber(static_cast<double>(c.y)),
             labNumber(static_cast<double>(c.z)));
}

std::vector<LabSection> labSections() {
    std::vector<LabSection> sections{
        {trLab("Light"), trLab("The environment, the cube and the irradiance"), {}},
        {trLab("Harmonics"),
         trLab("The environment from its first 1 to 8 bands of spherical harmonics; magenta is "
               "below "
               "zero"),
         {}},
        {trLab("Prefilter"),
         trLab("What reflections are looked up in: the environment blurred with the lobe of each "
               "roughness"),
         {}},
        {trLab("DFG"),
         trLab("What the lobe reflects, by angle and roughness: albedo = F0 · scale + bias"),
         {}}};
    for (const LabKind kind :
         {LabKind::Environment, LabKind::Faces, LabKind::Irradiance, LabKind::IrradianceExact})
        sections[0].views.push_back({kind, 0});
    for (int bands = 1; bands <= kMaxShOrder; ++bands)
        sections[1].views.push_back({LabKind::Harmonics, bands});
    for (int level = 0; level < kRoughnessSteps; ++level)
        sections[2].views.push_back({LabKind::Prefiltered, level});
    for (int channel = 0; channel < 3; ++channel)
        sections[3].views.push_back({LabKind::Dfg, channel});
    return sections;
}

LabCaption labCaption(LabView view, bool whole, const LabLight& light, double irradianceError) {
    LabCaption c;
    const EnvironmentLookup& lookup = light.lookup;
    const auto faces = [&](std::size_t level) {
        return trLab("%1 × %1").arg(lookup.maps->prefiltered[level].size);
    };
    const bool draft =
        lookup.maps && static_cast<int>(lookup.maps->prefiltered.size()) < IblSettings().levels;
    switch (view.kind) {
    case LabKind::Environment: {
        c.title = trLab("Environment");
        QStringList parts;
        if (lookup.analysis)
            parts << trLab("%1 × %2")
                         .arg(lookup.analysis->environment->width())
                         .arg(lookup.analysis->environment->height());
        const Orientation& stands = lookup.orientation;
        if (!stands.isIdentity() && !whole)
            parts.clear(); // room for one of both
        if (stands.rotationDeg != 0.0f)
            parts << trLab("rotated %1°").arg(labFixed(static_cast<double>(stands.rotationDeg), 1));
        if (stands.tiltDeg != 0.0f)
            parts << trLab("tilted %1°").arg(labFixed(static_cast<double>(stands.tiltDeg), 1));
        if (stands.rollDeg != 0.0f)
            parts << trLab("rolled %1°").arg(labFixed(static_cast<double>(stands.rollDeg), 1));
        if (whole && lookup.analysis)
            parts << trLab("RMS %1").arg(labNumber(lookup.rms()));
        c.detail = parts.join(QStringLiteral(" · "));
        break;
    }
    case LabKind::Faces:
        c.title = view.isFace() ? trLab("Face %1").arg(QString::fromUtf8(labFace(view.index).name))
                                : trLab("Cube faces");
        if (lookup.maps)
            c.detail = view.isFace() ? trLab("%1 texels, click for all faces").arg(faces(0))
                       : whole       ? trLab("%1 texels each, click one").arg(faces(0))
                                     : trLab("%1 each").arg(faces(0));
        break;
    case LabKind::Irradiance:
        c.title = whole ? trLab("Irradiance from 9 coefficients") : trLab("Irradiance, SH 9");
        if (lookup.maps)
            c.detail = trLab("%1 % off").arg(labFixed(100.0 * irradianceError, 1));
        if (whole && lookup.maps)
            c.detail = trLab("as SH irradiance takes it, %1 % RMS from the exact one, shown over π")
                           .arg(labFixed(100.0 * irradianceError, 1));
        break;
    case LabKind::IrradianceExact:
        c.title = whole ? trLab("Irradiance, exact") : trLab("Irradiance");
        c.detail = whole ? trLab("as surfaces take it: ∫ L cos, the widest prefiltered level times "
                                 "π; shown over π")
                         : trLab("exact");
        break;
    case LabKind::Harmonics: {
        const int n = view.index;
        c.title = n == 1 ? trLab("1 band") : trLab("%1 bands").arg(n);
        if (!lookup.analysis)
            break;
        const BandSumError sum = lookup.bandSumError(n);
        c.detail = trLab("RMSE %1").arg(fourDigits(sum.rmse));
        if (whole)
            c.detail =
                trLab("%1, %2 % of the light's RMS; %3")
                    .arg(c.detail, labFixed(100.0 * sum.share, 2),
                         n == 1 ? trLab("1 coefficient") : trLab("%1 coefficients").arg(n * n));
        if (sum.belowZero)
            c.warning = trLab("lowest %1").arg(labNumber(sum.lowest));
        break;
    }
    case LabKind::Prefiltered: {
        const float r = roughnessStep(view.index);
        c.title = trLab("Roughness %1").arg(labFixed(static_cast<double>(r), 2));
        if (!lookup.maps)
            break;
        const LevelPair levels = levelsOf(*lookup.maps, r);
        c.detail = faces(levels.first);
        if (whole)
            c.detail =
                levels.share > 0.0f
                    ? trLab("perceptual roughness, between levels %1 and %2, %3 texels per face")
                          .arg(levels.first)
                          .arg(levels.second)
                          .arg(c.detail)
                    : trLab("perceptual roughness, level %1, %2 texels per face")
                          .arg(levels.first)
                          .arg(c.detail);
        if (draft)
            c.detail = trLab("%1, draft").arg(c.detail);
        break;
    }
    case LabKind::Dfg: {
        const QString titles[] = {trLab("Scale A"), trLab("Bias B"), trLab("Mean direction")};
        const QString shorts[] = {trLab("times F0"), trLab("for any F0"),
                                  trLab("lean to the mirror")};
        const QString wholes[] = {trLab("albedo = F0 · A + B"), trLab("albedo = F0 · A + B"),
                                  trLab("0 along the normal, 1 along the mirror direction")};
        c.title = titles[view.index];
        c.detail = whole ? wholes[view.index] : shorts[view.index];
        break;
    }
    }
    return c;
}

} // namespace patina::editor

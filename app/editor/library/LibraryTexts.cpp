#include "app/editor/library/LibraryTexts.h"

#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "core/catalog/EnvironmentTags.h"
#include "core/light/Blackbody.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <vector>

namespace patina::editor {
namespace {

QString trLibrary(const char* text) {
    return QCoreApplication::translate("LibraryTexts", text);
}

QString kelvins(double kelvin) {
    const QString rounded = QStringLiteral("%L1 K").arg(qRound(kelvin / 50.0) * 50);
    // The ends stand for what lies beyond.
    if (kelvin > 0.98 * static_cast<double>(kMaxTemperatureK))
        return QStringLiteral("≥ ") + rounded;
    return rounded;
}

// Less from one side than from all others has no direction worth stating.
constexpr double kLeastDirectionality = 0.02;

QString percent(double share) {
    if (share < 0.001)
        return trLibrary("less than 0.1 %");
    return trLibrary("%1 %").arg(100.0 * share, 0, 'f', share < 0.1 ? 1 : 0);
}

QString degrees(double value) {
    return QStringLiteral("%1°").arg(qRound(value));
}

QString stops(double range) {
    return range >= kMostStops ? trLibrary("%1 stops or more").arg(kMostStops)
                               : trLibrary("%1 stops").arg(range, 0, 'f', 1);
}

QString ratio(double keyToFill) {
    return keyToFill >= kMostKeyToFill ? trLibrary("%1 : 1 or more").arg(kMostKeyToFill)
                                       : trLibrary("%1 : 1").arg(keyToFill, 0, 'f', 1);
}

QString luminance(double value) {
    return QString::number(value, 'g', 3);
}

QString fileText(const LibraryItem& item) {
    const CatalogEntry& entry = *item.entry;
    QStringList facts{trLibrary("%1 × %2").arg(entry.width).arg(entry.height),
                      toQString(entry.layout)};
    facts << (entry.fileBytes == 0
                  ? trLibrary("built in")
                  : QLocale().formattedDataSize(static_cast<qint64>(entry.fileBytes), 1,
                                                QLocale::DataSizeTraditionalFormat));
    return facts.join(QStringLiteral(" · "));
}

QString directionText(double elevationDeg, double azimuthDeg) {
    return trLibrary("elevation %1, azimuth %2").arg(degrees(elevationDeg), degrees(azimuthDeg));
}

struct Fact {
    QString name, value;
};

// All that is known of it but its tags.
std::vector<Fact> factsOf(const LibraryItem& item) {
    std::vector<Fact> facts;
    if (!item.measured)
        return {{trLibrary("Measured"), trLibrary("not yet")}};
    const EnvironmentMeasures& m = item.entry->measures;
    facts.push_back({trLibrary("Picture"), fileText(item)});
    if (!item.duplicateOf.isEmpty())
        facts.push_back({trLibrary("Same light as"), item.duplicateOf});
    if (m.source)
        facts.push_back(
            {m.source->isClear ? trLibrary("Brightest source") : trLibrary("Brightest place"),
             trLibrary("%1 of the light, %2")
                 .arg(percent(m.source->share),
                      directionText(m.source->elevationDeg, m.source->azimuthDeg))});
    facts.push_back({trLibrary("Dynamic range"), stops(m.rangeStops)});
    facts.push_back({trLibrary("Key to fill"), ratio(m.keyToFill)});
    facts.push_back({trLibrary("Colour temperature"),
                     m.temperature ? kelvins(m.temperature->kelvin)
                                   : trLibrary("none: no colour of a black body")});
    facts.push_back({trLibrary("Mean luminance"), luminance(m.meanLuminance)});
    if (m.directionality >= kLeastDirectionality)
        facts.push_back({trLibrary("Light comes from"),
                         directionText(m.dominantElevationDeg, m.dominantAzimuthDeg)});
    if (m.clippedShare > 0.0)
        facts.push_back({trLibrary("Clipped"),
                         trLibrary("%1 % of the sphere").arg(100.0 * m.clippedShare, 0, 'g', 2)});
    for (const std::string& notice : item.entry->notices)
        facts.push_back({trLibrary("Note"), toQString(notice)});
    return facts;
}

} // namespace

QString tagsText(const LibraryItem& item) {
    QStringList words;
    if (item.measured)
        for (const EnvironmentTag tag : tagsOf(item.entry->measures))
            words << toQString(tagLabel(tag));
    if (!item.duplicateOf.isEmpty())
        words << trLibrary("Duplicate");
    return words.join(QStringLiteral(", "));
}

QString sortedText(const LibraryItem& item, CatalogSort sort) {
    if (!item.measured)
        return trLibrary("not measured yet");
    if (sort == CatalogSort::Name)
        return trLibrary("%1 × %2").arg(item.entry->width).arg(item.entry->height);
    const std::optional<double> number = sortNumber(item.entry->measures, sort);
    if (!number)
        return QStringLiteral("–");
    switch (sort) {
    case CatalogSort::Name:
        break;
    case CatalogSort::SunElevation:
        return trLibrary("sun at %1").arg(degrees(*number));
    case CatalogSort::SunShare:
        return trLibrary("%1 of the light").arg(percent(*number));
    case CatalogSort::Range:
        return stops(*number);
    case CatalogSort::KeyToFill:
        return ratio(*number);
    case CatalogSort::Temperature:
        return kelvins(*number);
    case CatalogSort::Brightness:
        return trLibrary("mean %1").arg(luminance(*number));
    }
    return {};
}

LibrarySummary summaryOf(const LibraryItem& item) {
    const CatalogEntry& entry = *item.entry;
    LibrarySummary summary{toQString(entry.title), trLibrary("not measured yet")};
    if (!item.measured)
        return summary;
    summary.name += trLibrary(" · %1 × %2").arg(entry.width).arg(entry.height);
    if (const QString tags = tagsText(item); !tags.isEmpty())
        summary.name += QStringLiteral(" · ") + tags;
    const EnvironmentMeasures& m = entry.measures;
    QStringList facts;
    if (m.source && m.source->isClear)
        facts << trLibrary("source %1 at %2")
                     .arg(percent(m.source->share), degrees(m.source->elevationDeg));
    facts << stops(m.rangeStops) << trLibrary("key to fill %1").arg(ratio(m.keyToFill));
    if (m.temperature)
        facts << kelvins(m.temperature->kelvin);
    facts << trLibrary("mean %1").arg(luminance(m.meanLuminance));
    summary.measures = facts.join(QStringLiteral(" · "));
    return summary;
}

QString describedText(const LibraryItem& item) {
    QStringList lines;
    for (const Fact& fact : factsOf(item))
        lines << trLibrary("%1: %2").arg(fact.name, fact.value);
    return lines.join(QStringLiteral("; "));
}

QString toolTipText(const LibraryItem& item) {
    const auto row = [](const QString& name, const QString& value) {
        return QStringLiteral("<tr><td style='padding-right: 12px; white-space: nowrap'>%1</td>"
                              "<td>%2</td></tr>")
            .arg(name.toHtmlEscaped(), value.toHtmlEscaped());
    };
    QString text =
        QStringLiteral("<p><b>%1</b></p><table>").arg(toQString(item.entry->title).toHtmlEscaped());
    for (const Fact& fact : factsOf(item))
        text += row(fact.name, fact.value);
    if (item.measured)
        for (const EnvironmentTag tag : tagsOf(item.entry->measures))
            text += row(toQString(tagLabel(tag)), toQString(tagHelp(tag)));
    return text + QStringLiteral("</table>");
}

} // namespace patina::editor

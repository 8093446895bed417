#include "app/editor/library/LibraryTexts.h"

#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "core/catalog/EnvironmentTags.h"
#include "core/light/Blackbody.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <cmath>

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

QString percent(double share) {
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
    if (!item.duplicateOf.isEmpty())
        facts << trLibrary("the same light as %1").arg(item.duplicateOf);
    return facts.join(QStringLiteral(" · "));
}

QString sourceText(const EnvironmentMeasures& m) {
    if (!m.source)
        return trLibrary("no bright source");
    return trLibrary(m.source->isClear
                         ? "brightest source has %1 of the light, elevation %2, azimuth %3"
                         : "brightest place has %1 of the light, elevation %2, azimuth %3")
        .arg(percent(m.source->share), degrees(m.source->elevationDeg),
             degrees(m.source->azimuthDeg));
}

QString measuresText(const EnvironmentMeasures& m) {
    QStringList facts{sourceText(m), trLibrary("dynamic range %1").arg(stops(m.rangeStops)),
                      trLibrary("key to fill %1").arg(ratio(m.keyToFill))};
    facts << (m.temperature ? kelvins(m.temperature->kelvin) : trLibrary("no colour temperature"));
    facts << trLibrary("mean luminance %1").arg(luminance(m.meanLuminance));
    facts << trLibrary("light from elevation %1, azimuth %2 on the mean")
                 .arg(degrees(m.dominantElevationDeg), degrees(m.dominantAzimuthDeg));
    if (m.clippedShare > 0.0)
        facts << trLibrary("clipped over %1 of the sphere")
                     .arg(QStringLiteral("%1 %").arg(100.0 * m.clippedShare, 0, 'g', 2));
    return facts.join(QStringLiteral(" · "));
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
    if (m.source)
        facts << trLibrary(m.source->isClear ? "source %1 at %2" : "brightest place %1 at %2")
                     .arg(percent(m.source->share), degrees(m.source->elevationDeg));
    facts << trLibrary("range %1").arg(stops(m.rangeStops))
          << trLibrary("key to fill %1").arg(ratio(m.keyToFill));
    if (m.temperature)
        facts << kelvins(m.temperature->kelvin);
    facts << trLibrary("mean %1").arg(luminance(m.meanLuminance));
    summary.measures = facts.join(QStringLiteral(" · "));
    return summary;
}

QString detailsText(const LibraryItem& item) {
    const QString title = toQString(item.entry->title);
    if (!item.measured)
        return trLibrary("%1: not measured yet").arg(title);
    QStringList lines{title + QStringLiteral(" · ") + fileText(item)};
    lines << measuresText(item.entry->measures);
    const QString tags = tagsText(item);
    if (!tags.isEmpty())
        lines << trLibrary("Tags: %1").arg(tags);
    for (const std::string& notice : item.entry->notices)
        lines << toQString(notice);
    return lines.join(QLatin1Char('\n'));
}

QString toolTipText(const LibraryItem& item) {
    QString text;
    for (const QString& line : detailsText(item).split(QLatin1Char('\n')))
        text += QStringLiteral("<p>%1</p>").arg(line.toHtmlEscaped());
    if (item.measured)
        for (const EnvironmentTag tag : tagsOf(item.entry->measures))
            text += QStringLiteral("<p><b>%1</b>: %2</p>")
                        .arg(toQString(tagLabel(tag)).toHtmlEscaped(),
                             toQString(tagHelp(tag)).toHtmlEscaped());
    return text;
}

} // namespace patina::editor

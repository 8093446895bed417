#include "app/editor/trace/BlameBars.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"

#include <QCoreApplication>
#include <QFontMetrics>
#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <functional>

namespace patina::editor {
namespace {

constexpr std::size_t kMostBars = 6;
constexpr double kLeastShare = 0.01; // that has a bar
constexpr int kBlameBarHeight = 8;

QString trBars(const char* text) {
    return QCoreApplication::translate("BlameBars", text);
}

QString percentText(double share) {
    const QString number = QLocale().toString(std::abs(100.0 * share), 'f', 0);
    return (share < -0.005 ? QStringLiteral("−%1 %") : QStringLiteral("%1 %")).arg(number);
}

QString hereText(const BlameBars::Bar& bar) {
    if (!bar.here)
        return {};
    const long share = std::lround(100.0 * *bar.here);
    return (share < 0 ? QStringLiteral("−%1 ± %2 %") : QStringLiteral("%1 ± %2 %"))
        .arg(QLocale().toString(static_cast<qlonglong>(std::abs(share))),
             QLocale().toString(
                 static_cast<qlonglong>(std::lround(100.0 * bar.hereNoise.value_or(0.0)))));
}

QString remedyText(BlameCause cause) {
    switch (infoOf(cause).remedy) {
    case BlameRemedy::BakeTransfer:
        return trBars("Bake Transfer reduces the largest");
    case BlameRemedy::PathTracing:
        return trBars("Path tracing alone avoids the largest");
    case BlameRemedy::None:
        break;
    }
    return {};
}

} // namespace

BlameBars blameBars(const BlameScore& score, const QString& of,
                    const std::optional<BlameScore>& here) {
    BlameBars result;
    result.title = trBars("Causes: %1").arg(of);
    if (here)
        result.here = here->isKnown ? trBars("here") : trBars("here: within the noise");
    if (!score.isKnown) {
        result.note = trBars("No error above the noise");
        return result;
    }
    const auto size = [](const BlameBars::Bar& bar) {
        return std::max(std::abs(bar.share), std::abs(bar.here.value_or(0.0)));
    };
    for (const BlameCauseInfo& info : blameCauses()) {
        BlameBars::Bar bar{toQString(info.label), score.of(info.cause).share, {}, {}};
        if (here && here->isKnown) {
            bar.here = here->of(info.cause).share;
            bar.hereNoise = here->of(info.cause).noise;
        }
        if (size(bar) >= kLeastShare)
            result.bars.push_back(bar);
    }
    if (result.bars.size() > kMostBars) { // the smallest go
        std::ranges::stable_sort(result.bars, std::greater(), size);
        result.bars.resize(kMostBars);
    }
    std::ranges::stable_sort(result.bars, std::greater(), &BlameBars::Bar::share);
    result.note = remedyText(*score.largest());
    return result;
}

QStringList BlameBars::lines() const {
    QStringList lines{here.isEmpty() ? title : title + QLatin1Char('\t') + here};
    for (const Bar& bar : bars)
        lines << QStringLiteral("%1\t%2").arg(bar.label, percentText(bar.share)) +
                     (bar.here ? QLatin1Char('\t') + hereText(bar) : QString());
    if (!note.isEmpty())
        lines << note;
    return lines;
}

int BlameBars::height(const QFontMetrics& metrics) const {
    const int rows = 1 + static_cast<int>(bars.size()) + (note.isEmpty() ? 0 : 1);
    return tokens::kGap + rows * metrics.lineSpacing();
}

void BlameBars::paint(QPainter& painter, const QRect& area) const {
    const QFontMetrics metrics = painter.fontMetrics();
    const int line = metrics.lineSpacing();
    int y = area.top() + tokens::kGap / 2;
    painter.fillRect(area.left(), y, area.width(), 1, QColor(tokens::kLine));
    y += tokens::kGap / 2;
    const auto row = [&] { return QRect(area.left(), y, area.width(), line); };
    const int above = here.isEmpty() ? 0 : metrics.horizontalAdvance(here) + tokens::kGap;
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(row(), Qt::AlignRight | Qt::AlignVCenter, here);
    painter.setPen(QColor(tokens::kText));
    painter.drawText(row(), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(title, Qt::ElideRight, area.width() - above));
    y += line;
    int labels = 0;
    double largest = 0.0;
    for (const Bar& bar : bars) {
        labels = std::max(labels, metrics.horizontalAdvance(bar.label));
        largest = std::max(largest, std::abs(bar.share));
    }
    const int number = metrics.horizontalAdvance(QStringLiteral("−100 %"));
    const bool hasHere =
        std::ranges::any_of(bars, [](const Bar& bar) { return bar.here.has_value(); });
    const int second =
        hasHere ? metrics.horizontalAdvance(QStringLiteral("−100 ± 100 %")) + tokens::kGap : 0;
    const QRect bounds(area.left() + labels + tokens::kGap, 0,
                       area.width() - labels - number - second - 2 * tokens::kGap, 0);
    for (const Bar& bar : bars) {
        painter.setPen(QColor(bar.share < 0.0 ? tokens::kTextDim : tokens::kText));
        painter.drawText(row(), Qt::AlignLeft | Qt::AlignVCenter, bar.label);
        painter.drawText(row().adjusted(0, 0, -second, 0), Qt::AlignRight | Qt::AlignVCenter,
                         percentText(bar.share));
        painter.drawText(row(), Qt::AlignRight | Qt::AlignVCenter, hereText(bar));
        const double part = largest > 0.0 ? std::abs(bar.share) / largest : 0.0;
        const int wide = static_cast<int>(std::lround(part * std::max(bounds.width(), 0)));
        const QRect filled(bounds.left(), y + (line - kBlameBarHeight) / 2, std::max(wide, 1),
                           kBlameBarHeight);
        // What hides another cause's error is an outline.
        if (bar.share < 0.0) {
            painter.setBrush(Qt::NoBrush);
            painter.drawRect(filled.adjusted(0, 0, -1, -1));
        } else {
            painter.fillRect(filled, QColor(tokens::kAccent));
        }
        y += line;
    }
    painter.setPen(QColor(tokens::kTextDim));
    if (!note.isEmpty())
        painter.drawText(row(), Qt::AlignLeft | Qt::AlignVCenter,
                         metrics.elidedText(note, Qt::ElideRight, area.width()));
}

} // namespace patina::editor

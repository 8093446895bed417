// What all plots share: colours and dashes of compared curves, round axis steps, numbers as text,
// and the box that reads values out under the pointer.
#pragma once

#include <QColor>
#include <QFont>
#include <QPainter>
#include <QPointF>
#include <QRectF>
#include <QString>
#include <vector>

namespace patina::editor {

// Curves that are compared differ in colour and in dash. The colours are Okabe and Ito's, which
// people with any colour vision can tell apart ("Color Universal Design", 2008).
inline constexpr int kPlotLooks = 4;
inline constexpr QRgb kPlotSun = 0xfffff0b8; // of the light under the lens
[[nodiscard]] QColor plotColor(int look);
[[nodiscard]] Qt::PenStyle plotDash(int look);
[[nodiscard]] QPen plotPen(int look, double width = 1.8);

[[nodiscard]] QFont plotFont(const QFont& font);                              // of axes
[[nodiscard]] QPointF plotPoint(const std::vector<QPointF>& curve, double x); // linear between

// Round steps, about `count` of them; ascending, all inside.
[[nodiscard]] std::vector<double> roundSteps(double min, double max, int count);
// Significant digits: "0.25", "1 230"; two at most of what needs a power, "4.1·10⁻⁵"; "∞", and "–"
// for what is no number.
[[nodiscard]] QString plotNumber(double value, int digits = 3);

struct ReadoutRow {
    int look = -1; // whose sample line stands before it; -1: none
    QString text;
    qsizetype name = 0; // characters at its beginning that are shortened where room is scarce
};
// Beside `at`, inside `area`.
void paintReadout(QPainter& painter, const QRectF& area, const QPointF& at, const QString& title,
                  const std::vector<ReadoutRow>& rows);

// The well that plots are drawn in, their title, and the dim words in place of curves.
void paintPlotWell(QPainter& painter, const QRectF& rect, const QString& title);
void paintPlotMessage(QPainter& painter, const QRectF& rect, const QString& message);
[[nodiscard]] double plotTitleHeight(const QFont& font);

// `count` cells as near to squares as the area allows, row by row.
[[nodiscard]] std::vector<QRectF> plotCells(const QRectF& area, int count, double gap);

} // namespace patina::editor

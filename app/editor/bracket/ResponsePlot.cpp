#include "app/editor/bracket/ResponsePlot.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"

#include <QPainterPath>
#include <array>
#include <cmath>
#include <numbers>

namespace patina::editor {
namespace {

constexpr double kDarkest = -8.0, kBrightest = 4.0; // stops against middle grey
constexpr QRgb kChannelColors[] = {tokens::kDanger, 0xff7fc27a, 0xff6ba6ea, tokens::kTextDim};
constexpr Qt::PenStyle kChannelDashes[] = {Qt::DotLine, Qt::DashLine, Qt::SolidLine};
constexpr int kSrgbLook = 3; // of the colours; of what is the same for all channels, too

// Codes over stops of light.
PlotCurve curveOf(const LogResponse& response, int look, CurveShape shape, const QString& name) {
    PlotCurve curve;
    curve.look = look;
    curve.shape = shape;
    curve.name = name;
    for (std::size_t code = 0; code < kCodes; ++code) {
        const double stops = response[code] / std::numbers::ln2;
        if (curve.points.empty() || stops > curve.points.back().x()) // codes may share one
            curve.points.emplace_back(stops, static_cast<double>(code));
    }
    return curve;
}

} // namespace

ResponsePlot::ResponsePlot(QWidget* parent)
    : CurvePlot(tr("Response"), parent) {
    setObjectName(QStringLiteral("bracketResponse"));
    setHelp(tr("Which code the camera gives for how much light, in stops around middle grey."));
    setEmptyText(tr("No response yet"));
    setAxes({tr("light"), tr(" EV"), kDarkest, kBrightest, 2.0}, {tr("code"), {}, 0.0, 255.0, 64.0},
            255.0);
}

void ResponsePlot::setReport(const BracketReport& report) {
    m_kind = toQString(responseText(report.response));
    std::vector<PlotCurve> curves;
    const std::array names{tr("Red"), tr("Green"), tr("Blue")};
    if (report.response == ResponseKind::Recovered && report.curves.size() == names.size())
        for (std::size_t c = 0; c < names.size(); ++c)
            curves.push_back(
                curveOf(report.curves[c], static_cast<int>(c), CurveShape::Line, names[c]));
    else if (!report.curves.empty())
        curves.push_back(curveOf(report.curves.front(), kSrgbLook, CurveShape::Line, tr("Code")));
    if (report.response == ResponseKind::Recovered)
        curves.push_back(curveOf(srgbResponse(), kSrgbLook, CurveShape::Thin, tr("sRGB")));
    setMessage(curves.empty() ? tr("The photos are linear: they have no response") : QString());
    setCurves(std::move(curves));
}

void ResponsePlot::clear() {
    m_kind.clear();
    setMessage({});
    setCurves({});
}

// Named by channel, in the channels' own colours: no sample line before them.
std::vector<PlotValue> ResponsePlot::valuesAt(const QPointF& place) const {
    std::vector<PlotValue> values = CurvePlot::valuesAt(place);
    for (PlotValue& value : values)
        value.look = -1;
    return values;
}

QColor ResponsePlot::colorOf(const PlotCurve& curve) const {
    return kChannelColors[curve.look];
}

void ResponsePlot::paintCurve(QPainter& painter, const PlotCurve& curve) const {
    QPen pen = curvePen(curve.shape, 0);
    pen.setColor(colorOf(curve));
    // Channels often lie on each other, red above green above blue: all of them stay in sight.
    if (curve.shape == CurveShape::Line && curve.look < kSrgbLook) {
        pen.setStyle(kChannelDashes[curve.look]);
        pen.setCapStyle(Qt::FlatCap);
    }
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(pathOf(curve));
}

} // namespace patina::editor

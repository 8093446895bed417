#include "app/editor/trace/PathErrorOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/PathBlame.h"
#include "app/editor/trace/PathError.h"
#include "core/document/Document.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"

#include <QKeyEvent>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr std::size_t kMostMaterials = 6; // in the box
constexpr int kBarHeight = 12;
constexpr int kBoxAlpha = 225; // of 255

std::optional<ErrorShown> errorShown(PathPicture shown) {
    switch (shown) {
    case PathPicture::Exposure:
        return ErrorShown::Exposure;
    case PathPicture::Relative:
        return ErrorShown::Relative;
    case PathPicture::Visible:
        return ErrorShown::Visible;
    case PathPicture::Traced:
    case PathPicture::Drawn:
        break;
    }
    return std::nullopt;
}

QString signedEv(double ev) {
    const QString number = QLocale().toString(std::abs(ev), 'f', 2);
    return (ev < -0.005 ? QStringLiteral("−") : QStringLiteral("+")) + number;
}

double luminanceAt(const Image& image, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(image.channels());
    const float* value = image.f32().data() + channels * pixel;
    return static_cast<double>(shading::luminance({value[0], value[1], value[2]}));
}

} // namespace

PathErrorOverlay::PathErrorOverlay(PathError& error, PathBlame& blame, QWidget& viewport)
    : QWidget(&viewport)
    , m_error(error)
    , m_blame(blame)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("pathError"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAccessibleName(tr("Error of the drawn picture"));
    hide();
    viewport.installEventFilter(this);
    connect(&error, &PathError::changed, this, &PathErrorOverlay::follow);
    connect(&blame, &PathBlame::changed, this, &PathErrorOverlay::follow);
}

void PathErrorOverlay::follow() {
    setVisible(m_error.isOn());
    setGeometry(m_viewport.rect());
    setAccessibleDescription((lines() + causes().lines()).join(QLatin1Char('\n')));
    update();
}

bool PathErrorOverlay::eventFilter(QObject*, QEvent* event) {
    switch (event->type()) {
    case QEvent::Resize:
        setGeometry(m_viewport.rect());
        break;
    case QEvent::MouseMove:
        m_pointer = static_cast<const QMouseEvent*>(event)->position();
        if (isVisible())
            update();
        break;
    case QEvent::Leave:
        m_pointer.reset();
        update();
        break;
    case QEvent::FocusOut:
        m_error.setPeeking(false);
        break;
    case QEvent::KeyPress:
    case QEvent::KeyRelease: {
        const auto* key = static_cast<const QKeyEvent*>(event);
        if (key->key() != Qt::Key_Space || !m_error.isOn())
            return false;
        if (!key->isAutoRepeat())
            m_error.setPeeking(event->type() == QEvent::KeyPress);
        return true;
    }
    default:
        break;
    }
    return false;
}

QStringList PathErrorOverlay::lines() const {
    if (!m_error.problem().isEmpty())
        return {tr("Cannot be compared: %1").arg(m_error.problem())};
    const auto& measured = m_error.measured();
    if (!measured)
        return {tr("Drawing and tracing…")};
    const QLocale locale;
    const auto row = [&](const QString& name, const ErrorScore& score) {
        return QStringLiteral("%1\t%2\t%3")
            .arg(name, locale.toString(score.flip, 'f', 3), signedEv(score.biasEv));
    };
    const PictureError& error = measured->error;
    QStringList lines{tr("\tFLIP\tEV"), row(tr("Picture"), error.whole),
                      tr("± noise\t%1\t%2")
                          .arg(locale.toString(error.whole.flipNoise, 'f', 3),
                               locale.toString(error.whole.biasEvNoise, 'f', 2))};
    for (std::size_t i = 0; i < std::min(error.materials.size(), kMostMaterials); ++i)
        if (const Material* material =
                m_error.controller().document().material(error.materials[i].material))
            lines << row(toQString(material->name), error.materials[i]);
    if (error.materials.size() > kMostMaterials)
        lines << tr("and %1 more materials").arg(error.materials.size() - kMostMaterials);
    lines << tr("Relative error  %1 %").arg(locale.toString(100.0 * error.whole.relative, 'f', 1));
    return lines;
}

QString PathErrorOverlay::pointedLine() const {
    const auto& measured = m_error.measured();
    if (!measured || !m_pointer || width() <= 0 || height() <= 0)
        return {};
    const Image& truth = measured->traced->radiance;
    const int x = static_cast<int>(m_pointer->x() * truth.width() / width());
    const int y = static_cast<int>(m_pointer->y() * truth.height() / height());
    if (x < 0 || y < 0 || x >= truth.width() || y >= truth.height())
        return {};
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width()) +
                       static_cast<std::size_t>(x);
    const double drawn = luminanceAt(*measured->drawn, pixel), traced = luminanceAt(truth, pixel);
    const auto error = static_cast<double>(measured->traced->standardError.f32()[pixel]);
    const QLocale locale;
    const auto number = [&](double value) { return locale.toString(value, 'g', 3); };
    const QString values =
        tr("Here drawn %1, traced %2 ± %3").arg(number(drawn), number(traced), number(error));
    return measured->error.withinNoise[pixel] != 0 ? values + tr(" (noise)") : values;
}

BlameBars PathErrorOverlay::causes() const {
    if (!m_error.measured())
        return {};
    if (!m_blame.problem().isEmpty())
        return {tr("Causes"), {}, {}, m_blame.problem()};
    if (!m_blame.found())
        return {tr("Causes"), {}, {}, tr("Drawing and tracing…")};
    std::optional<QPointF> position;
    if (m_pointer && width() > 0 && height() > 0)
        position = QPointF(m_pointer->x() / width(), m_pointer->y() / height());
    const BlameScore& score = m_blame.scoreAt(position);
    const Material* material = m_error.controller().document().material(score.material);
    return blameBars(score, material != nullptr ? toQString(material->name) : tr("picture"),
                     m_blame.hereAt(position));
}

int PathErrorOverlay::paintLegend(QPainter& painter, const QRect& box, int y) const {
    const auto shown = errorShown(m_error.isPeeking() ? PathPicture::Drawn : m_error.shown());
    if (!shown)
        return y;
    const ErrorColors colors = errorColors(*shown);
    for (int x = 0; x < box.width(); ++x) {
        const glm::vec3 color =
            mapColor(colors.map, static_cast<float>(x) / static_cast<float>(box.width() - 1));
        painter.fillRect(box.left() + x, y, 1, kBarHeight,
                         QColor::fromRgbF(color.r, color.g, color.b));
    }
    y += kBarHeight;
    const QRect scale(box.left(), y, box.width(), fontMetrics().lineSpacing());
    painter.setPen(QColor(tokens::kText));
    const auto ends = [&](const QString& from, const QString& middle, const QString& to) {
        painter.drawText(scale, Qt::AlignLeft, from);
        painter.drawText(scale, Qt::AlignHCenter, middle);
        painter.drawText(scale, Qt::AlignRight, to);
    };
    if (*shown == ErrorShown::Exposure)
        ends(tr("−1 EV, too dark"), QString(), tr("too bright, +1 EV"));
    else if (*shown == ErrorShown::Relative)
        ends(tr("0 %"), tr("25 %"), tr("50 %"));
    else
        ends(tr("0 equal"), tr("FLIP"), tr("1 unlike"));
    y += scale.height();
    const QRect note(box.left(), y, box.width(), fontMetrics().lineSpacing());
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(note, Qt::AlignLeft, tr("Hatched: within the noise"));
    return note.bottom() + tokens::kGap / 2;
}

void PathErrorOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    if (const QImage picture = m_error.picture(); !picture.isNull())
        painter.drawImage(rect(), picture);
    QStringList texts = lines();
    const QString pointed = pointedLine();
    const int line = fontMetrics().lineSpacing(), margin = tokens::kMargin;
    const int widest = std::min(fontMetrics().horizontalAdvance(QString(42, QLatin1Char('0'))),
                                width() - 4 * margin);
    const bool hasLegend =
        errorShown(m_error.isPeeking() ? PathPicture::Drawn : m_error.shown()).has_value();
    const int legend = hasLegend ? kBarHeight + 2 * line + tokens::kGap : 0;
    const int rows = static_cast<int>(texts.size()) + (pointed.isEmpty() ? 0 : 1);
    const BlameBars bars = causes();
    const int barsHeight = bars.title.isEmpty() ? 0 : bars.height(fontMetrics());
    const QRect box(width() - widest - 3 * margin, margin, widest + 2 * margin,
                    legend + rows * line + barsHeight + 2 * margin);
    QColor behind(tokens::kPanel);
    behind.setAlpha(kBoxAlpha);
    painter.setPen(Qt::NoPen);
    painter.setBrush(behind);
    painter.drawRoundedRect(box, tokens::kRadius, tokens::kRadius);
    const QRect inner = box.adjusted(margin, margin, -margin, -margin);
    int y = paintLegend(painter, inner, inner.top());
    painter.setPen(QColor(tokens::kText));
    if (!pointed.isEmpty())
        texts << pointed;
    const int number = fontMetrics().horizontalAdvance(QStringLiteral("+00.00 "));
    for (const QString& text : texts) {
        const QRect row(inner.left(), y, inner.width(), line);
        const QStringList columns = text.split(QLatin1Char('\t'));
        painter.drawText(
            row.adjusted(0, 0, columns.size() > 1 ? -2 * number : 0, 0),
            Qt::AlignLeft | Qt::AlignVCenter,
            fontMetrics().elidedText(columns[0], Qt::ElideRight,
                                     row.width() - (columns.size() > 1 ? 2 * number : 0)));
        for (qsizetype c = 1; c < columns.size(); ++c)
            painter.drawText(
                row.adjusted(0, 0, -number * static_cast<int>(columns.size() - 1 - c), 0),
                Qt::AlignRight | Qt::AlignVCenter, columns[c]);
        y += line;
    }
    if (barsHeight > 0)
        bars.paint(painter, QRect(inner.left(), y, inner.width(), barsHeight));
}

} // namespace patina::editor

#include "app/editor/panel/LightLabPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/LatestJob.h"
#include "app/editor/panel/LabTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/ReflowGrid.h"
#include "app/editor/widget/RowLabel.h"
#include "app/editor/widget/Slider.h"
#include "core/base/Check.h"

#include <QButtonGroup>
#include <QLabel>
#include <QScrollBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kColumn = 100;        // narrowest thumbnail
constexpr double kMaxOffsetEv = 8;  // of the exposure
constexpr double kWideAspect = 1.4; // from here on the large picture is beside the sheet

// A small square of the colour that is read out.
class Swatch : public QWidget {
  public:
    Swatch() {
        setFixedSize(28, 28);
        setAutoFillBackground(true);
        setAccessibleName(QObject::tr("Colour under the pointer"));
    }
};

} // namespace

LightLabPanel::LightLabPanel(DocumentController& controller, IblUpdater& ibl, PixelProbe& probe,
                             QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_ibl(ibl)
    , m_probe(probe)
    , m_analysisJob(
          new LatestJob(controller.runner(), "light lab, analysis", this, TaskPriority::High))
    , m_dfgJob(new LatestJob(controller.runner(), "light lab, DFG table", this))
    , m_pictureJob(
          new LatestJob(controller.runner(), "light lab, pictures", this, TaskPriority::High)) {
    setObjectName(QStringLiteral("lightLabPanel"));
    m_request.setSingleShot(true);
    m_request.setInterval(0); // after the layout, and once for many reasons
    connect(&m_request, &QTimer::timeout, this, &LightLabPanel::requestPictures);

    auto* bar = new QWidget;
    m_bar = new QBoxLayout(QBoxLayout::LeftToRight, bar);
    m_bar->setContentsMargins(0, 0, tokens::kMargin, 0);
    m_bar->setSpacing(tokens::kGap);
    m_bar->addWidget(makeSections());
    m_bar->addWidget(makeExposure(), 1);

    m_stage = new LabPicture({LabKind::Environment, 0}, LabPicture::Role::Stage);
    m_stage->setObjectName(QStringLiteral("labStage"));
    m_large.widget = m_stage;
    m_swatch = new Swatch;
    m_where = new ElidedLabel;
    m_what = new ElidedLabel;
    m_note = new ElidedLabel;
    m_where->setObjectName(QStringLiteral("dim"));
    m_where->setAccessibleName(tr("Direction under the pointer"));
    m_what->setAccessibleName(tr("Light under the pointer"));
    m_note->setAccessibleName(tr("Note on the light"));
    QPalette warning = m_note->palette();
    warning.setColor(QPalette::WindowText, QColor(tokens::kCopper));
    m_note->setPalette(warning);
    auto* lines = new QVBoxLayout;
    lines->setSpacing(0);
    lines->addWidget(m_where);
    lines->addWidget(m_what);
    auto* readout = new QHBoxLayout;
    readout->setSpacing(tokens::kGap);
    readout->addWidget(m_swatch);
    readout->addLayout(lines, 1);
    m_stageColumn = new QWidget;
    auto* column = new QVBoxLayout(m_stageColumn);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addWidget(m_stage, 1);
    column->addLayout(readout);
    column->addWidget(m_note);
    column->addStretch(0);

    m_body = new QBoxLayout(QBoxLayout::LeftToRight);
    m_body->setSpacing(tokens::kMargin);
    m_body->addWidget(m_stageColumn);
    m_body->addWidget(makeSheet(), 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kMargin, tokens::kGap, 0, 0);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(bar);
    layout->addLayout(m_body, 1);

    connectPicture(m_stage);
    connect(m_stage, &LabPicture::faceChosen, this, [this](int face) {
        select({LabKind::Faces, face});
    });
    connect(&controller, &DocumentController::changed, this, &LightLabPanel::follow);
    connect(&ibl, &IblUpdater::mapsReady, this, &LightLabPanel::refreshMaps);
    connect(&probe, &PixelProbe::hoverChanged, this, &LightLabPanel::refreshPicked);
    connect(&probe, &PixelProbe::pinChanged, this, &LightLabPanel::refreshPicked);
    select({LabKind::Environment, 0});
    point(nullptr, std::nullopt);
}

LightLabPanel::~LightLabPanel() {
    setSeen(false);
}

// --- Widgets -------------------------------------------------------------------------------------

QWidget* LightLabPanel::makeSections() {
    auto* buttons = new QWidget;
    auto* row = new QHBoxLayout(buttons);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    auto* group = new QButtonGroup(buttons);
    const auto add = [&](const QString& text, const QString& help, int index) {
        auto* button = new QToolButton;
        button->setObjectName(QStringLiteral("segment"));
        button->setText(text);
        button->setToolTip(help);
        button->setStatusTip(help);
        button->setAccessibleName(tr("Show %1").arg(text));
        button->setCheckable(true);
        button->setFocusPolicy(Qt::TabFocus);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        group->addButton(button);
        row->addWidget(button);
        connect(button, &QToolButton::clicked, this, [this, index] { showSection(index); });
        return button;
    };
    const std::vector<LabSection> sections = labSections();
    CHECK_EQ(sections.size(), m_sections.size());
    m_allButton = add(tr("All"), tr("Show all pictures of the light"), -1);
    m_allButton->setChecked(true);
    for (std::size_t i = 0; i < m_sections.size(); ++i)
        m_sections[i].button = add(sections[i].name, sections[i].help, static_cast<int>(i));
    return buttons;
}

QWidget* LightLabPanel::makeExposure() {
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    const QString help = tr("How much brighter or darker than in the viewport the light is shown, "
                            "in stops; the scene does not change");
    auto* label = new RowLabel(tr("Exposure"));
    label->setToolTip(tr("%1.\nDouble-click: as in the viewport.").arg(help));
    m_slider = new Slider(-kMaxOffsetEv, kMaxOffsetEv, 0.0);
    NumberFormat format;
    format.softMin = format.hardMin = -kMaxOffsetEv;
    format.softMax = format.hardMax = kMaxOffsetEv;
    format.decimals = 2;
    format.unit = tr(" EV");
    m_exposure = new NumberField(format);
    m_exposure->setFixedWidth(tokens::kFieldWidth);
    for (QWidget* widget : {static_cast<QWidget*>(m_slider), static_cast<QWidget*>(m_exposure)}) {
        widget->setToolTip(help);
        widget->setStatusTip(help);
        widget->setAccessibleName(widget == m_slider ? tr("Light lab exposure slider")
                                                     : tr("Light lab exposure"));
    }
    layout->addWidget(label);
    layout->addWidget(m_slider, 1);
    layout->addWidget(m_exposure);
    const auto set = [this](double ev) {
        m_offsetEv = static_cast<float>(ev);
        m_slider->setValue(ev);
        m_exposure->setValue(ev);
        invalidate();
    };
    connect(m_slider, &Slider::dragged, this, set);
    for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
        connect(m_exposure, signal, this, set);
    connect(label, &RowLabel::resetRequested, this, [set] { set(0.0); });
    return row;
}

QWidget* LightLabPanel::makeSheet() {
    auto* scroll = new PanelScroll;
    m_scroll = scroll;
    scroll->contents()->setContentsMargins(0, 0, tokens::kGap, tokens::kGap);
    scroll->contents()->setSpacing(4);
    const std::vector<LabSection> specs = labSections();
    for (std::size_t i = 0; i < m_sections.size(); ++i) {
        const LabSection& spec = specs[i];
        Section& section = m_sections[i];
        section.first = spec.views.front();
        section.box = new QWidget;
        auto* layout = new QVBoxLayout(section.box);
        layout->setContentsMargins(0, 0, 0, 4);
        layout->setSpacing(0);
        section.heading = new QLabel(spec.name);
        section.heading->setObjectName(QStringLiteral("dim"));
        section.heading->setToolTip(spec.help);
        section.heading->setContentsMargins(4, 0, 0, 0);
        layout->addWidget(section.heading);
        auto* grid = new ReflowGrid(kColumn, 2);
        layout->addLayout(grid);
        for (const LabView& view : spec.views) {
            auto* widget = new LabPicture(view, LabPicture::Role::Thumbnail);
            widget->setStatusTip(spec.help);
            grid->addWidget(widget);
            m_cells.push_back({widget, 0, {}});
            connectPicture(widget);
            connect(widget, &LabPicture::chosen, this, [this, view] { select(view); });
            connect(widget, &LabPicture::stepped, this, &LightLabPanel::step);
        }
        scroll->contents()->addWidget(section.box);
    }
    scroll->contents()->addStretch(1);
    connect(scroll->verticalScrollBar(), &QScrollBar::valueChanged, this,
            [this] { m_request.start(); });
    return scroll;
}

void LightLabPanel::connectPicture(LabPicture* widget) {
    connect(widget, &LabPicture::resized, this, [this] { m_request.start(); });
    connect(widget, &LabPicture::pointed, this,
            [this, widget](const std::optional<LabPlace>& place) { point(widget, place); });
    widget->setReader([this, widget](const LabPlace& place) {
        std::vector<PlotValue> values;
        const std::optional<glm::vec3> v = valueAt(widget->view(), place);
        if (v && widget->view().isTable())
            values = {{tr("A"), {double{v->x}}},
                      {tr("B"), {double{v->y}}},
                      {tr("mean direction"), {double{v->z}}}};
        else if (v)
            values = {{{}, {double{v->x}, double{v->y}, double{v->z}}}};
        return values;
    });
}

LabPicture* LightLabPanel::picture(LabView view) const {
    if (view.isFace())
        view.index = 0; // of the cross
    const auto found = std::ranges::find_if(
        m_cells, [&](const Cell& cell) { return cell.widget->view() == view; });
    return found == m_cells.end() ? nullptr : found->widget;
}

QStringList LightLabPanel::readout() const {
    return {m_where->text(), m_what->text()};
}

bool LightLabPanel::idle() const {
    return !m_request.isActive() && !m_analysisJob->busy() && !m_dfgJob->busy() &&
           !m_pictureJob->busy();
}

QSize LightLabPanel::sizeHint() const {
    return {780, 280};
}
QSize LightLabPanel::minimumSizeHint() const {
    return {300, 180};
}

void LightLabPanel::arrange() {
    const bool wide = width() > kWideAspect * height();
    const bool barWide = width() > 560;
    m_bar->setDirection(barWide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_body->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    const int bar = (barWide ? 1 : 2) * (tokens::kRowHeight + tokens::kGap) + tokens::kGap;
    const int caption = m_stage->heightForWidth(0), readout = m_swatch->height() + 8;
    m_stageColumn->setMinimumSize(0, 0);
    m_stageColumn->setMaximumSize(QWIDGETSIZE_MAX, QWIDGETSIZE_MAX);
    m_stageColumn->setContentsMargins(0, 0, wide ? 0 : tokens::kMargin, wide ? tokens::kGap : 0);
    int column = width() - 2 * tokens::kMargin;
    if (wide) {
        // As wide as a panorama of the full height; the sheet keeps room for three columns.
        const int picture = 2 * (height() - bar - caption - readout - tokens::kGap);
        const int sheet = std::min(3 * (kColumn + 2) + 24, width() / 2);
        column = std::clamp(picture, std::min(220, width() / 2),
                            std::max(width() / 2, std::min(width() - sheet, width() * 11 / 20)));
        m_stageColumn->setFixedWidth(column);
    } else {
        m_stageColumn->setFixedHeight(std::min(
            column / 2 + caption + readout + (m_note->isHidden() ? 0 : 20), (height() - bar) / 2));
    }
    // Where there is height to spare it stays below what is read, not in between.
    m_stage->setMaximumHeight(m_stage->view().isTable() ? QWIDGETSIZE_MAX : column / 2 + caption);
}

void LightLabPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void LightLabPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    setSeen(true);
}

void LightLabPanel::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    setSeen(false);
}

void LightLabPanel::setSeen(bool seen) {
    if (seen == m_seen)
        return;
    m_seen = seen;
    if (!seen) {
        m_probe.removeListener();
        m_light.lookup.maps = nullptr; // large
        return;
    }
    m_probe.addListener();
    refreshDfg();
    refreshLight();
    refreshMaps();
    refreshPicked();
}

void LightLabPanel::showSection(int index) {
    (index < 0 ? m_allButton : m_sections[static_cast<std::size_t>(index)].button)
        ->setChecked(true);
    for (std::size_t i = 0; i < m_sections.size(); ++i) {
        m_sections[i].box->setVisible(index < 0 || static_cast<int>(i) == index);
        m_sections[i].heading->setVisible(index < 0);
    }
    if (index >= 0 && !picture(m_stage->view())->isVisibleTo(this))
        select(m_sections[static_cast<std::size_t>(index)].first);
    m_scroll->verticalScrollBar()->setValue(0);
    m_request.start();
}

void LightLabPanel::select(LabView view) {
    for (Cell& cell : m_cells)
        cell.widget->setSelected(cell.widget == picture(view));
    m_stage->setView(view);
    m_large.state = 0;
    arrange();
    if (view.isTable() && m_dfg) {
        const auto channel = static_cast<std::size_t>(view.index);
        m_stage->setPicture(m_dfg->pictures[channel]);
        m_stage->setColorRange(m_dfg->range[channel]);
    } else if (!view.isTable()) {
        if (!view.isFace())
            m_stage->setPicture(picture(view)->picture()); // until the large one is there
    }
    refreshCaptions();
    refreshPicked();
    point(nullptr, std::nullopt);
    m_request.start();
}

void LightLabPanel::step(int by) {
    std::vector<LabPicture*> shown;
    for (const Cell& cell : m_cells)
        if (cell.widget->isVisibleTo(this))
            shown.push_back(cell.widget);
    const auto current = std::ranges::find_if(
        shown, [&](const LabPicture* p) { return p == picture(m_stage->view()); });
    if (current == shown.end())
        return;
    const auto index = std::clamp<std::ptrdiff_t>(current - shown.begin() + by, 0,
                                                  static_cast<std::ptrdiff_t>(shown.size()) - 1);
    LabPicture* next = shown[static_cast<std::size_t>(index)];
    select(next->view());
    next->setFocus();
    m_scroll->ensureWidgetVisible(next, 0, 4);
}

} // namespace patina::editor

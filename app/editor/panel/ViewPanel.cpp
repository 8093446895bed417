#include "app/editor/panel/ViewPanel.h"

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/Section.h"
#include "app/editor/widget/ToneCurvePlot.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kCurvePoints = 257;
constexpr Target kView{Scope::View, 0};

// Rows of the view's parameters that belong to camera and lighting, or the others.
std::vector<std::string_view> rows(bool ofCamera) {
    std::vector<std::string_view> ids;
    for (const ParameterInfo& info : parameters())
        if (info.scope == Scope::View && (info.group == "Camera and lighting") == ofCamera)
            ids.push_back(info.id);
    return ids;
}

ParameterListSpec listWithout(std::vector<std::string_view> ids) {
    ParameterListSpec spec;
    spec.scope = Scope::View;
    spec.target = [] { return std::optional(kView); };
    spec.without = std::move(ids);
    return spec;
}

QString signedEv(float ev) {
    return QStringLiteral("%1%2 EV")
        .arg(ev < -0.005f ? QStringLiteral("−") : QStringLiteral("+"))
        .arg(std::abs(ev), 0, 'f', 2);
}

// A number under its caption.
QWidget* figure(const QString& caption, const QString& help, QLabel*& value) {
    auto* box = new QWidget;
    auto* layout = new QVBoxLayout(box);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto* title = new QLabel(caption);
    title->setObjectName(QStringLiteral("dim"));
    value = new QLabel(QStringLiteral("–"));
    value->setAccessibleName(caption);
    layout->addWidget(title);
    layout->addWidget(value);
    box->setToolTip(help);
    box->setStatusTip(help);
    return box;
}

QStringList toList(const std::vector<std::string>& names) {
    QStringList list;
    for (const std::string& name : names)
        list << QString::fromStdString(name);
    return list;
}

void fill(QComboBox& box, const QStringList& names, const QString& current) {
    QStringList shown;
    for (int i = 0; i < box.count(); ++i)
        shown << box.itemText(i);
    if (shown != names) {
        box.clear();
        box.addItems(names);
    }
    box.setCurrentIndex(static_cast<int>(names.indexOf(current)));
}

QComboBox* nameBox(const QString& name, const QString& help) {
    auto* box = new QComboBox;
    box->setAccessibleName(name);
    box->setToolTip(help);
    box->setStatusTip(help);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(6);
    box->setFocusPolicy(Qt::StrongFocus);
    return box;
}

} // namespace

ViewPanel::ViewPanel(DocumentController& controller, DisplayLoader& displays,
                     Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_displays(displays)
    , m_plot(new ToneCurvePlot)
    , m_parameters(new ParameterList(controller, thumbnails, listWithout(rows(true)))) {
    // What OpenColorIO has to choose from stands right below the tone curve and the display.
    ParameterListSpec camera = listWithout(rows(false));
    camera.loneHeading = true;
    auto* scroll = new PanelScroll;
    scroll->contents()->addWidget(makeCurve());
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addWidget(makeDisplay());
    scroll->contents()->addWidget(new ParameterList(controller, thumbnails, std::move(camera)));
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::View)
            refresh();
    });
    connect(&displays, &DisplayLoader::changed, this, &ViewPanel::refresh);
    refresh();
}

QWidget* ViewPanel::makeCurve() {
    auto* box = new QWidget;
    auto* layout = new QVBoxLayout(box);
    layout->setContentsMargins(0, 0, 0, 4);
    layout->setSpacing(6);
    layout->addWidget(m_plot);
    auto* figures = new QHBoxLayout;
    figures->setSpacing(tokens::kGap);
    figures->addWidget(figure(tr("Average"),
                              tr("Log-average luminance of the picture, before exposure"),
                              m_average),
                       1);
    figures->addWidget(figure(tr("Adapted to"),
                              tr("Luminance that automatic exposure is used to by now"), m_adapted),
                       1);
    figures->addWidget(
        figure(tr("Exposure"), tr("Exposure in force, automatic part included"), m_exposure), 1);
    layout->addLayout(figures);
    return box;
}

QWidget* ViewPanel::makeDisplay() {
    auto* section = new Section(tr("OpenColorIO"));
    m_config = new ElidedLabel;
    m_problem = new QLabel;
    m_space = new QLabel;
    m_clear = new QToolButton;
    auto* browseButton = new QPushButton(icon(QStringLiteral("open")), tr("Browse…"));
    browseButton->setToolTip(tr("Show the scene through the displays and views of an OpenColorIO "
                                "configuration"));
    browseButton->setStatusTip(browseButton->toolTip());
    browseButton->setAccessibleName(tr("Choose an OpenColorIO configuration"));
    m_clear->setIcon(icon(QStringLiteral("remove")));
    m_clear->setToolTip(tr("Leave the configuration and use the one of the environment, if any"));
    m_clear->setStatusTip(m_clear->toolTip());
    m_clear->setAccessibleName(tr("Leave the OpenColorIO configuration"));
    m_clear->setFocusPolicy(Qt::TabFocus);
    auto* file = new QWidget;
    auto* fileRow = new QHBoxLayout(file);
    fileRow->setContentsMargins(0, 0, 0, 0);
    fileRow->setSpacing(4);
    fileRow->addWidget(m_config, 1);
    fileRow->addWidget(m_clear);
    fileRow->addWidget(browseButton);

    m_display = nameBox(tr("OpenColorIO display"), tr("The display of the configuration that "
                                                      "stands before you"));
    m_view = nameBox(tr("OpenColorIO view"), tr("How the display shows the scene"));
    m_choices = new QWidget;
    auto* form = new QFormLayout(m_choices);
    form->setContentsMargins(0, 0, 0, 0);
    form->setSpacing(6);
    form->addRow(tr("Display"), m_display);
    form->addRow(tr("View"), m_view);
    m_space->setObjectName(QStringLiteral("dim"));
    for (QLabel* label : {m_problem, m_space}) {
        label->setWordWrap(true);
        label->setTextFormat(Qt::PlainText);
    }
    QPalette warning = m_problem->palette();
    warning.setColor(QPalette::WindowText, QColor(tokens::kCopper));
    m_problem->setPalette(warning);
    for (QWidget* widget : {static_cast<QWidget*>(file), static_cast<QWidget*>(m_problem),
                            m_choices, static_cast<QWidget*>(m_space)})
        section->add(widget);

    connect(browseButton, &QPushButton::clicked, this, &ViewPanel::browse);
    connect(m_clear, &QToolButton::clicked, this, [this] { m_controller.setDisplayConfig({}); });
    connect(m_display, &QComboBox::activated, this,
            [this](int index) { m_controller.setDisplayView(m_display->itemText(index), {}); });
    connect(m_view, &QComboBox::activated, this, [this](int index) {
        m_controller.setDisplayView(m_display->currentText(), m_view->itemText(index));
    });
    return section;
}

void ViewPanel::setLuminance(const Luminance& luminance) {
    m_luminance = luminance;
    refreshCurve();
}

void ViewPanel::refresh() {
    m_parameters->refresh(); // what is offered may depend on the configuration
    refreshCurve();
    refreshDisplay();
}

void ViewPanel::refreshCurve() {
    const View& view = m_controller.document().view;
    const Luminance luminance = m_luminance.value_or(Luminance{});
    const bool foreign = view.toneMap == ToneMap::OpenColorIo;
    if (foreign && m_displays.transform()) {
        m_plot->setCurve(m_displays.transform()->curve);
    } else {
        View shown = view;
        if (foreign)
            shown.toneMap = View().toneMap; // what stands in for it
        std::vector<float> values;
        for (int i = 0; i < kCurvePoints; ++i) {
            const float stops =
                ToneCurvePlot::kStops *
                (2.0f * static_cast<float>(i) / static_cast<float>(kCurvePoints - 1) - 1.0f);
            values.push_back(displayedGrey(shown, luminance, 0.18f * std::exp2(stops)));
        }
        m_plot->setCurve(std::move(values));
    }

    const bool known = m_luminance.has_value();
    m_plot->setAverage(known ? std::optional(std::log2(static_cast<double>(
                                   exposureScale(view, luminance) * luminance.logAverage / 0.18f)))
                             : std::nullopt);
    const QString none = QStringLiteral("–");
    m_average->setText(known ? QString::number(static_cast<double>(luminance.logAverage), 'g', 3)
                             : none);
    m_adapted->setText(known && view.exposureMode == ExposureMode::Automatic
                           ? QString::number(static_cast<double>(luminance.adapted), 'g', 3)
                           : none);
    m_exposure->setText(known || !needsLuminance(view) ? signedEv(exposureInForce(view, luminance))
                                                       : none);
}

void ViewPanel::refreshDisplay() {
    const View& view = m_controller.document().view;
    const QString config = QString::fromStdString(openColorIoConfig(view.ocioConfig));
    m_config->setText(config.isEmpty() ? tr("No configuration") : shownFileName(config));
    m_config->setToolTip(view.ocioConfig.empty() && !config.isEmpty()
                             ? tr("%1\nas the environment variable OCIO says").arg(config)
                             : config);
    m_clear->setVisible(!view.ocioConfig.empty());

    const bool shown = view.toneMap == ToneMap::OpenColorIo;
    m_problem->setText(m_displays.problem());
    m_problem->setVisible(shown && !m_displays.problem().isEmpty());
    const std::optional<DisplayMenu>& menu = m_displays.menu();
    m_choices->setVisible(shown && menu.has_value());
    if (menu) {
        QStringList names;
        for (const DisplayMenu::Display& display : menu->displays)
            names << QString::fromStdString(display.name);
        const DisplayMenu::Display* display = menu->find(view.ocioDisplay);
        fill(*m_display, names, display ? QString::fromStdString(display->name) : QString());
        fill(*m_view, display ? toList(display->views) : QStringList(),
             QString::fromStdString(!view.ocioView.empty() ? view.ocioView
                                    : display              ? display->defaultView
                                                           : std::string()));
    }
    const DisplayTransformPtr transform = shown ? m_displays.transform() : nullptr;
    m_space->setVisible(transform != nullptr);
    if (transform)
        m_space->setText(
            tr("Linear Rec.709 enters as %1.").arg(QString::fromStdString(transform->space)));
}

void ViewPanel::browse() {
    const QString key = QStringLiteral("folders/openColorIo");
    auto* dialog = new QFileDialog(window(), tr("Choose OpenColorIO Configuration"),
                                   proposedFolder(m_controller, key), displayConfigFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, [this, key](const QString& file) {
        rememberFolder(m_controller, key, file);
        m_controller.setDisplayConfig(file);
    });
    dialog->open();
}

} // namespace patina::editor

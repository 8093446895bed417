#include "app/editor/panel/EnvironmentPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/SkyGallery.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

bool applies(const ParameterInfo& info, const Document& document, Id) {
    return info.id != "environment.backgroundColor" ||
           document.environment.background == BackgroundMode::Color;
}

} // namespace

EnvironmentPanel::EnvironmentPanel(DocumentController& controller, Thumbnails& thumbnails,
                                   QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_previews(new BackgroundTasks(1, this))
    , m_gallery(new SkyGallery)
    , m_source(new ElidedLabel)
    , m_parameters(
          new ParameterList(controller, thumbnails,
                            {Scope::Environment,
                             [] {
                                 return std::optional(Target{Scope::Environment, 0});
                             },
                             {"environment.image"}, // the gallery and the line with the file
                             applies})) {
    m_gallery->setTasks(*m_previews);
    auto* browseButton = new QPushButton(icon(QStringLiteral("open")), tr("Browse…"));
    browseButton->setToolTip(tr("Light the scene with an HDR or EXR panorama from a file"));
    browseButton->setStatusTip(browseButton->toolTip());
    browseButton->setAccessibleName(tr("Choose an environment file"));

    auto* file = new QHBoxLayout;
    file->addWidget(m_source, 1);
    file->addWidget(browseButton);
    auto* scroll = new PanelScroll;
    scroll->contents()->addWidget(m_gallery);
    scroll->contents()->addLayout(file);
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(m_gallery, &SkyGallery::chosen, this, [this](const QString& source) {
        m_controller.setEnvironment(source);
        refresh(); // the mark follows the document, not the click
    });
    connect(browseButton, &QPushButton::clicked, this, &EnvironmentPanel::browse);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::Environment)
            refresh();
    });
    refresh();
}

void EnvironmentPanel::refresh() {
    const Environment& environment = m_controller.document().environment;
    const QString source = QString::fromStdString(environment.source);
    m_gallery->setCurrent(source);
    m_source->setText(MapSlotWidget::sourceTitle(environment.source));
    const bool broken = !environment.problem.empty();
    m_source->setToolTip(broken ? QString::fromStdString(environment.problem) : source);
    QPalette colors = m_source->palette();
    colors.setColor(QPalette::WindowText, QColor(broken ? tokens::kCopper : tokens::kTextDim));
    m_source->setPalette(colors);
}

void EnvironmentPanel::browse() {
    const QString key = QStringLiteral("folders/environments");
    auto* dialog = new QFileDialog(window(), tr("Choose Environment"),
                                   QSettings().value(key).toString(), environmentFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, [this, key](const QString& file) {
        QSettings().setValue(key, QFileInfo(file).absolutePath());
        m_controller.setEnvironment(file);
    });
    dialog->open();
}

} // namespace patina::editor

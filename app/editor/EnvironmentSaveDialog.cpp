#include "app/editor/EnvironmentSaveDialog.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/scene/EnvironmentFile.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr const char* kFolderKey = "folders/environments";
constexpr int kOpenExr = 0; // of the formats
constexpr int kSmallestSize = 2, kLargestSize = 16384;

QString suggestedEnvironmentPath(const DocumentController& controller) {
    return QDir(proposedFolder(controller, QLatin1String(kFolderKey)))
        .filePath(QStringLiteral("environment.exr"));
}

} // namespace

EnvironmentSaveDialog::EnvironmentSaveDialog(DocumentController& controller, JobManager& jobs,
                                             QWidget* parent)
    : QDialog(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_output(new OutputFile(
          QStringLiteral("environmentSave"),
          {{tr("OpenEXR (32-bit float)"), QStringLiteral("exr"), QStringLiteral("OpenEXR")},
           {tr("Radiance HDR"), QStringLiteral("hdr"), QStringLiteral("Radiance HDR")}},
          suggestedEnvironmentPath(controller), *this)) {
    connect(m_output, &OutputFile::changed, this, &EnvironmentSaveDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &EnvironmentSaveDialog::run);
    setObjectName(QStringLiteral("environmentSaveDialog"));
    setWindowTitle(tr("Save Environment As"));
    resize(620, 300);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    layout->addWidget(makeSettings());
    m_summary = new QLabel;
    m_summary->setObjectName(QStringLiteral("environmentSaveSummary"));
    m_summary->setWordWrap(true);
    layout->addWidget(m_summary);
    layout->addStretch(1);

    m_output->addButtons(*layout, tr("Save"));
    layoutChosen();
}

QWidget* EnvironmentSaveDialog::makeSettings() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);

    m_layout = withHelp(new QComboBox, tr("How the picture shows the environment"));
    m_layout->setObjectName(QStringLiteral("environmentSaveLayout"));
    for (int i = static_cast<int>(EnvironmentLayout::LatLong);
         i <= static_cast<int>(EnvironmentLayout::SixFaces); ++i) {
        const std::string_view label = layoutLabel(static_cast<EnvironmentLayout>(i));
        m_layout->addItem(QString::fromUtf8(label.data(), static_cast<qsizetype>(label.size())), i);
    }
    form->addRow(tr("&Layout"), m_layout);
    m_output->addFormatRow(*form, tr("OpenEXR is exact, Radiance smaller and read everywhere"));
    m_size = withHelp(new QSpinBox, tr("Width of a lat-long, diameter of a disc, side of a face"));
    m_size->setObjectName(QStringLiteral("environmentSaveSize"));
    m_size->setRange(kSmallestSize, kLargestSize);
    m_size->setSuffix(tr(" px"));
    form->addRow(tr("&Size"), m_size);

    m_output->addFileRow(*form);
    m_asShown = withHelp(new QCheckBox(tr("Turned and brightened as in the scene")),
                         tr("Applies the environment's rotation and brightness to the file"));
    m_asShown->setObjectName(QStringLiteral("environmentSaveAsShown"));
    m_asShown->setChecked(true);
    form->addRow(QString(), m_asShown);
    m_envmap = withHelp(new QCheckBox(tr("OpenEXR's own convention (envmap attribute)")),
                        tr("For programs that follow OpenEXR's envmap attribute; others see such a "
                           "lat-long half a turn away"));
    m_envmap->setObjectName(QStringLiteral("environmentSaveEnvmap"));
    form->addRow(QString(), m_envmap);

    connect(m_layout, &QComboBox::currentIndexChanged, this, &EnvironmentSaveDialog::layoutChosen);
    connect(m_size, &QSpinBox::valueChanged, this, &EnvironmentSaveDialog::refresh);
    connect(m_envmap, &QCheckBox::toggled, this, &EnvironmentSaveDialog::refresh);
    return widget;
}

EnvironmentSaveSettings EnvironmentSaveDialog::settings() const {
    EnvironmentSaveSettings settings;
    settings.output = QFile::encodeName(m_output->path()).toStdString();
    settings.layout = static_cast<EnvironmentLayout>(m_layout->currentData().toInt());
    settings.size = m_size->value();
    settings.openExrEnvmap = m_envmap->isEnabled() && m_envmap->isChecked();
    return settings;
}

void EnvironmentSaveDialog::layoutChosen() {
    const ImagePtr& image = m_controller.document().environment().image;
    const auto layout = static_cast<EnvironmentLayout>(m_layout->currentData().toInt());
    m_size->setSingleStep(layout == EnvironmentLayout::LatLong ? 2 : 1);
    m_size->setValue(environmentSaveSize(layout, image ? image->width() : kSmallestSize));
    refresh();
}

void EnvironmentSaveDialog::refresh() {
    const EnvironmentSaveSettings wanted = settings();
    m_envmap->setEnabled(m_output->format() == kOpenExr &&
                         (wanted.layout == EnvironmentLayout::LatLong ||
                          wanted.layout == EnvironmentLayout::VerticalStrip));
    const auto files = environmentOutputs(settings());
    const bool possible = files.ok() && m_controller.document().environment().image != nullptr;
    bool overwrites = false;
    QString summary;
    if (possible) {
        for (const std::filesystem::path& file : *files)
            overwrites = overwrites || QFileInfo::exists(fromPath(file));
        const ImageSize size = files->size() > 1
                                   ? ImageSize{wanted.size, wanted.size}
                                   : EnvironmentMapping::imageSize(wanted.layout, wanted.size);
        summary = files->size() > 1
                      ? tr("Six files of %1 × %2 pixels: %3 …")
                            .arg(size.width)
                            .arg(size.height)
                            .arg(shownFileName(fromPath(files->front())))
                      : tr("One file of %1 × %2 pixels").arg(size.width).arg(size.height);
        if (overwrites)
            summary += tr("; existing files will be overwritten");
    } else if (!files) {
        summary = UserNotice::fromError(files.error()).text;
    }
    m_summary->setText(summary);
    m_summary->setStyleSheet(overwrites || !possible
                                 ? QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name())
                                 : QString());
    m_output->setRunnable(possible, overwrites ? tr("Overwrite") : tr("Save"));
}

void EnvironmentSaveDialog::run() {
    // The job works on a snapshot: editing goes on meanwhile.
    Environment environment = m_controller.document().environment();
    if (!m_asShown->isChecked()) {
        environment.rotationDeg = environment.tiltDeg = environment.rollDeg = 0.0f;
        environment.exposureEv = 0.0f;
    }
    rememberFolder(m_controller, QLatin1String(kFolderKey), m_output->path());
    m_jobs.start(tr("Save environment: %1").arg(shownFileName(m_output->path())), false,
                 [environment, wanted = settings(), worker = &m_controller.worker(),
                  controller = &m_controller](const JobContext& job) -> JobOutcome {
                     const auto written = saveEnvironment(*worker, environment, wanted, job);
                     if (!written)
                         return {written.error(), {}, {}};
                     const QString file = fromPath(written->front());
                     return {
                         std::nullopt, file, [controller, file] {
                             UserNotice notice;
                             notice.text =
                                 EnvironmentSaveDialog::tr("Saved the environment to %1").arg(file);
                             Q_EMIT controller->noticed(notice);
                         }};
                 });
    accept();
}

} // namespace patina::editor

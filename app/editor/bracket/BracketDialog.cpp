#include "app/editor/bracket/BracketDialog.h"

#include "app/editor/bracket/BracketPicture.h"
#include "app/editor/bracket/BracketTable.h"
#include "app/editor/bracket/ResponsePlot.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/io/ImageIO.h"

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kBracketTag = "bracket";
constexpr int kPreviewSide = 1200;   // pixels
constexpr int kProgressMs = 100;     // between looks at it
constexpr double kMostViewEv = 16.0; // either way

struct Merged {
    std::shared_ptr<const Bracket> bracket;
    std::shared_ptr<const BracketPreview> preview;
};

// Beside the photos, by the name of the first.
QString suggestedHdrPath(const QStringList& photos) {
    if (photos.isEmpty())
        return QStringLiteral("photos.exr");
    const QFileInfo first(photos.front());
    return first.dir().filePath(first.completeBaseName() + QStringLiteral("-hdr.exr"));
}

std::vector<std::filesystem::path> pathsOf(const QStringList& photos) {
    std::vector<std::filesystem::path> paths;
    for (const QString& photo : photos)
        paths.push_back(toPath(photo));
    return paths;
}

QString legendEntry(const MarkColor& color, const QString& text) {
    return QStringLiteral("<span style=\"color:%1\">■</span>&nbsp;%2")
        .arg(QColor(color[0], color[1], color[2]).name(), text);
}

QString percentText(double share) {
    return QString::number(100.0 * share, 'f', 2) + BracketDialog::tr(" %");
}

void colorWords(QLabel& label, bool warning) {
    label.setStyleSheet(warning ? QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name())
                                : QString());
}

} // namespace

BracketDialog::BracketDialog(DocumentController& controller, JobManager& jobs,
                             const QStringList& photos, QWidget* parent)
    : QDialog(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_photos(photos)
    , m_output(new OutputFile(
          QStringLiteral("bracket"),
          {{tr("OpenEXR (32-bit float)"), QStringLiteral("exr"), QStringLiteral("OpenEXR")},
           {tr("Radiance HDR"), QStringLiteral("hdr"), QStringLiteral("Radiance HDR")}},
          suggestedHdrPath(photos), *this))
    , m_tasks(controller.runner()) {
    m_photos.sort();
    setObjectName(QStringLiteral("bracketDialog"));
    setWindowTitle(photos.size() > 1 ? tr("Make HDR from %1 Photos").arg(photos.size())
                                     : tr("Make HDR from Photos"));
    resize(1200, 620);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    auto* columns = new QHBoxLayout;
    columns->setSpacing(20);
    columns->addWidget(makePhotos(), 1);
    columns->addWidget(makeResult(), 1);
    layout->addLayout(columns, 1);
    m_warnings = new QLabel;
    m_warnings->setObjectName(QStringLiteral("bracketWarnings"));
    m_warnings->setWordWrap(true);
    colorWords(*m_warnings, true);
    m_warnings->hide();
    layout->addWidget(m_warnings);
    layout->addWidget(makeOutput());
    m_output->addButtons(*layout, tr("Save"));
    connect(m_output, &OutputFile::changed, this, &BracketDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &BracketDialog::save);
    connect(&m_progress, &QTimer::timeout, this, &BracketDialog::showProgress);
    m_progress.setInterval(kProgressMs);
    m_marks->setFocus(); // not a number, which the wheel would change
    refresh();
    readExposures();
}

QWidget* BracketDialog::makePhotos() {
    auto* widget = new QWidget;
    auto* layout = new QVBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    m_table = new BracketTable(m_photos);
    connect(m_table, &BracketTable::exposureTyped, this, &BracketDialog::merge);
    layout->addWidget(m_table, 3);
    m_align = describe(new QCheckBox(tr("&Align photos")), tr("Align photos"),
                       tr("Moves the photos by whole pixels so that they lie on each other; for "
                          "those taken without a tripod"));
    m_align->setObjectName(QStringLiteral("bracketAlign"));
    m_align->setChecked(true);
    connect(m_align, &QCheckBox::toggled, this, &BracketDialog::merge);
    layout->addWidget(m_align);
    m_response = new ResponsePlot;
    layout->addWidget(m_response, 2);
    return widget;
}

QWidget* BracketDialog::makeResult() {
    auto* widget = new QWidget;
    auto* layout = new QVBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    m_picture = new BracketPicture;
    layout->addWidget(m_picture, 1);

    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kGap);
    m_marks = describe(new QCheckBox(tr("&Mark doubtful pixels")), tr("Mark doubtful pixels"),
                       tr("Colours what is clipped in all photos and where they disagree"));
    m_marks->setObjectName(QStringLiteral("bracketMarks"));
    m_marks->setChecked(true);
    connect(m_marks, &QCheckBox::toggled, m_picture, &BracketPicture::setMarks);
    row->addWidget(m_marks);
    row->addStretch(1);
    auto* label = new QLabel(tr("&View at"));
    m_exposure = describe(new QDoubleSpinBox, tr("View at"),
                          tr("Brightens or darkens the picture here; what is written stays as it "
                             "is"));
    m_exposure->setObjectName(QStringLiteral("bracketViewEv"));
    m_exposure->setRange(-kMostViewEv, kMostViewEv);
    m_exposure->setDecimals(1);
    m_exposure->setSingleStep(0.5);
    m_exposure->setSuffix(tr(" EV"));
    label->setBuddy(m_exposure);
    connect(m_exposure, &QDoubleSpinBox::valueChanged, m_picture, &BracketPicture::setExposure);
    row->addWidget(label);
    row->addWidget(m_exposure);
    layout->addLayout(row);

    m_legend = new QLabel;
    m_legend->setObjectName(QStringLiteral("bracketLegend"));
    m_legend->setTextFormat(Qt::RichText);
    m_legend->setWordWrap(true);
    layout->addWidget(m_legend);
    return widget;
}

QWidget* BracketDialog::makeOutput() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    m_output->addFormatRow(*form, tr("OpenEXR is exact, Radiance smaller and read everywhere"));
    m_output->addFileRow(*form);
    m_use = describe(new QCheckBox(tr("&Use as environment")), tr("Use as environment"),
                     tr("Lights the scene with the file that is written; a panorama of all "
                        "directions, twice as wide as high"));
    m_use->setObjectName(QStringLiteral("bracketUse"));
    connect(m_use, &QCheckBox::toggled, this, &BracketDialog::refresh);
    auto* row = new QHBoxLayout;
    row->setSpacing(20);
    row->addWidget(m_use);
    m_summary = new QLabel;
    m_summary->setObjectName(QStringLiteral("bracketSummary"));
    m_summary->setWordWrap(true);
    row->addWidget(m_summary, 1);
    form->addRow(QString(), row);
    return widget;
}

QString BracketDialog::message() const {
    return m_picture->message();
}

// --- Work ----------------------------------------------------------------------------------------

void BracketDialog::readExposures() {
    m_picture->setMessage(tr("Reading exposures"));
    const std::vector<std::filesystem::path> files = pathsOf(m_photos);
    using Exposures = std::vector<PhotoExposure>;
    m_tasks.run(
        {.tag = kBracketTag, .name = "exposures of photos"},
        [files, worker = &m_controller.worker()](const JobContext& job) -> Result<Exposures> {
            Exposures exposures;
            for (const std::filesystem::path& file : files) {
                if (job.cancelled())
                    return Error{ErrorKind::Cancelled, "it was cancelled", {}, {}};
                Result<PhotoExposure> exposure = readExposure(*worker, file);
                if (!exposure)
                    return exposure.error();
                exposures.push_back(*exposure);
            }
            return exposures;
        },
        [this, files](const Result<Exposures>& exposures) {
            if (!exposures) {
                m_picture->setMessage(UserNotice::fromError(exposures.error()).text, true);
                return;
            }
            const Result<std::vector<double>> evs = exposuresEv(files, *exposures);
            m_table->setExposures(*exposures, evs ? *evs : std::vector<double>());
            if (!evs) {
                m_picture->setMessage(
                    tr("%1\n\nType the exposures of the photos into the list, in stops.")
                        .arg(UserNotice::fromError(evs.error()).text),
                    true);
                return;
            }
            merge();
        });
}

void BracketDialog::merge() {
    m_bracket.reset();
    m_response->clear();
    m_table->clearFound();
    m_warnings->clear();
    m_warnings->hide();
    m_legend->clear();
    refresh();
    BracketOptions options;
    options.exposuresEv = m_table->exposuresEv();
    options.align = m_align->isChecked();
    m_running = m_tasks.run(
        {.tag = kBracketTag, .priority = TaskPriority::Low, .name = "merging photos"},
        [files = pathsOf(m_photos), options,
         worker = &m_controller.worker()](const JobContext& job) -> Result<Merged> {
            Result<Bracket> bracket = makeBracket(*worker, files, options, job);
            if (!bracket)
                return bracket.error();
            Merged merged;
            merged.preview =
                std::make_shared<const BracketPreview>(shrinkMerged(bracket->merged, kPreviewSide));
            merged.bracket = std::make_shared<const Bracket>(std::move(*bracket));
            return merged;
        },
        [this](const Result<Merged>& merged) {
            m_running.reset();
            m_progress.stop();
            if (!merged) {
                m_picture->setPreview(nullptr);
                m_picture->setMessage(UserNotice::fromError(merged.error()).text, true);
                return;
            }
            m_bracket = merged->bracket;
            m_picture->setMessage({});
            m_picture->setPreview(merged->preview);
            showResult();
        });
    showProgress();
    m_progress.start();
}

void BracketDialog::showProgress() {
    if (!m_running)
        return;
    const JobProgress progress = m_running->progress();
    QString activity = QString::fromStdString(progress.activity);
    if (activity.isEmpty())
        activity = tr("reading photos");
    activity[0] = activity[0].toUpper();
    m_picture->setMessage(tr("%1, %2 %").arg(activity).arg(qRound(100.0 * progress.fraction)));
}

void BracketDialog::showResult() {
    const BracketReport& report = m_bracket->report;
    m_table->setFound(report);
    m_response->setReport(report);
    m_legend->setText(
        QStringList{legendEntry(kMarkColors.above,
                                tr("white in all photos %1").arg(percentText(report.clippedAbove))),
                    legendEntry(kMarkColors.below,
                                tr("black in all photos %1").arg(percentText(report.clippedBelow))),
                    legendEntry(kMarkColors.disagrees,
                                tr("photos disagree %1").arg(percentText(report.disagreeing)))}
            .join(QStringLiteral(" &nbsp; ")));
    QStringList warnings;
    for (const std::string& warning : report.warnings) {
        QString text = QString::fromStdString(warning);
        text[0] = text[0].toUpper();
        warnings << text + QLatin1Char('.');
    }
    // However many there are, the picture stays in sight.
    constexpr qsizetype kShown = 2;
    QString shown = warnings.mid(0, kShown).join(QLatin1Char('\n'));
    if (warnings.size() > kShown)
        shown += QLatin1Char(' ') + tr("And %1 more.").arg(warnings.size() - kShown);
    m_warnings->setText(shown);
    m_warnings->setVisible(!shown.isEmpty());
    m_warnings->setToolTip(warnings.join(QLatin1Char('\n')));
    refresh();
}

// --- What is written -----------------------------------------------------------------------------

bool BracketDialog::isPanorama() const {
    if (!m_bracket)
        return false;
    const Image& image = m_bracket->merged.image;
    return image.width() == 2 * image.height();
}

void BracketDialog::refresh() {
    const Result<ImageFileFormat> format = imageFormatForPath(toPath(m_output->path()));
    const bool writable = !m_output->path().isEmpty() && format.ok() &&
                          (*format == ImageFileFormat::Exr || *format == ImageFileFormat::Hdr);
    const bool overwrites = writable && QFileInfo::exists(m_output->path());
    m_use->setEnabled(isPanorama());
    QString summary;
    if (!writable) {
        summary = tr("The name ends in .exr or .hdr; choose one of these endings.");
    } else if (m_bracket) {
        const Image& image = m_bracket->merged.image;
        summary = tr("%1 × %2 pixels").arg(image.width()).arg(image.height());
        if (!isPanorama())
            summary += tr("; no panorama (2:1) that could light the scene");
        if (overwrites)
            summary += tr("; the existing file will be overwritten");
    }
    m_summary->setText(summary);
    colorWords(*m_summary, overwrites || !writable);
    const bool uses = m_use->isEnabled() && m_use->isChecked();
    m_output->setRunnable(writable && m_bracket != nullptr,
                          overwrites ? (uses ? tr("Overwrite and Use") : tr("Overwrite"))
                                     : (uses ? tr("Save and Use") : tr("Save")));
}

void BracketDialog::save() {
    const QString file = m_output->path();
    const bool uses = m_use->isEnabled() && m_use->isChecked();
    m_jobs.start(tr("Save HDR: %1").arg(shownFileName(file)), false,
                 [bracket = m_bracket, file, uses, worker = &m_controller.worker(),
                  controller = &m_controller](const JobContext&) -> JobOutcome {
                     const Result<void> saved =
                         saveImage(*worker, bracket->merged.image, toPath(file));
                     if (!saved)
                         return {saved.error(), {}, {}};
                     return {std::nullopt, file, [controller, file, uses] {
                                 UserNotice notice;
                                 notice.text =
                                     BracketDialog::tr("Saved the merged photos to %1").arg(file);
                                 Q_EMIT controller->noticed(notice);
                                 if (uses)
                                     controller->setEnvironment(file);
                             }};
                 });
    accept();
}

} // namespace patina::editor

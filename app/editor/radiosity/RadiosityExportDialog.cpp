#include "app/editor/radiosity/RadiosityExportDialog.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/base/LowerCase.h"
#include "core/document/SceneSource.h"
#include "core/radiosity/document/LitFiles.h"
#include "core/radiosity/document/RadiosityLightMap.h"
#include "core/radiosity/document/Reexpose.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>
#include <memory>
#include <optional>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kExportFolderKey = "folders/exports";
enum Format { kDae, kGlb, kGltf, kPly };
enum Place { kVertices, kLightMap };

// What the job works on: editing goes on meanwhile.
struct RadiosityExport {
    Document document;
    LiveRadiosityPtr live;
    radiosity::Solution solution; // as it is shown: after a step, or all of it
    std::optional<int> lightMapSize;
    ExposureRequest exposure;
    LitFilesSettings files;
};

Result<ExportPlan> planOf(const RadiosityExport& work, const JobContext& job) {
    const SolvedSurfaces solved{*work.live->scene, work.live->elements(), work.live->lit};
    job.setActivity("collecting light");
    const std::vector<LitPart> parts = litParts(solved, work.solution);
    const double automatic = automaticExposure(work.document, parts);
    std::optional<double> k;
    if (work.exposure.kind == ExposureRequest::Kind::Automatic)
        k = automatic;
    else if (work.exposure.kind == ExposureRequest::Kind::Value)
        k = work.exposure.k;
    if (!work.lightMapSize)
        return planLitFiles(litDocument(work.document, parts, k), work.document, work.files);
    RadiosityMapSettings settings;
    settings.size = *work.lightMapSize;
    const auto map = radiosityLightMap(solved, work.solution, settings, job);
    if (!map)
        return map.error();
    return planLitFiles(litDocument(work.document, *map, k, automatic), work.document, work.files);
}

} // namespace

ColladaOrigin colladaOrigin(const Document& document) {
    std::optional<SceneSource> origin;
    for (const MeshInstance& instance : document.meshes) {
        const SceneSource source = parseSceneSource(instance.source);
        if (lowerCase(std::filesystem::path(source.file).extension().string()) != ".dae" ||
            (origin && (origin->file != source.file || origin->title != source.title)))
            return {};
        origin = source;
    }
    return origin ? ColladaOrigin{origin->file, origin->title} : ColladaOrigin{};
}

RadiosityExportDialog::RadiosityExportDialog(DocumentController& controller,
                                             RadiosityUpdater& radiosity, JobManager& jobs,
                                             QWidget* parent)
    : QDialog(parent)
    , m_controller(controller)
    , m_radiosity(radiosity)
    , m_jobs(jobs)
    , m_origin(colladaOrigin(controller.document()))
    , m_output(new OutputFile(
          QStringLiteral("radiosityExport"),
          {{tr("COLLADA"), QStringLiteral("dae"), QStringLiteral("COLLADA")},
           {tr("GLB (one file)"), QStringLiteral("glb"), QStringLiteral("glTF binary")},
           {tr("glTF (.gltf with its files)"), QStringLiteral("gltf"), QStringLiteral("glTF")},
           {tr("PLY"), QStringLiteral("ply"), QStringLiteral("Stanford PLY")}},
          proposedFile(controller, QLatin1String(kExportFolderKey),
                       QStringLiteral("-radiosity.dae")),
          *this)) {
    connect(m_output, &OutputFile::changed, this, &RadiosityExportDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &RadiosityExportDialog::run);
    setObjectName(QStringLiteral("radiosityExportDialog"));
    setWindowTitle(tr("Export Radiosity"));
    resize(640, 360);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    layout->addWidget(makeSettings());
    m_summary = new QLabel;
    m_summary->setObjectName(QStringLiteral("radiosityExportSummary"));
    m_summary->setWordWrap(true);
    layout->addWidget(m_summary);
    layout->addStretch(1);
    m_output->addButtons(*layout, tr("Export"));
    refresh();
}

QWidget* RadiosityExportDialog::makeSettings() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    m_output->addFormatRow(*form, tr("COLLADA, glTF and PLY have colours that other programs show, "
                                     "and the unclamped light beside them"));
    m_output->addFileRow(*form);
    m_intoOrigin = withHelp(
        new QCheckBox(tr("Into the document that the scene came from")),
        m_origin.file.empty()
            ? tr("Not all meshes of the scene come from one COLLADA file: a new document is "
                 "written")
            : tr("Copies %1, with its cameras, animations and whatever else it holds, and puts the "
                 "light into the copy; off: writes a new document of what is solved")
                  .arg(shownFileName(fromPath(m_origin.file))));
    m_intoOrigin->setObjectName(QStringLiteral("radiosityExportIntoOrigin"));
    m_intoOrigin->setChecked(!m_origin.file.empty());
    form->addRow(QString(), m_intoOrigin);

    m_light = withHelp(new QComboBox,
                       tr("Where the light lives: in colours of the divided surfaces' vertices, or "
                          "in a texture of the surfaces as they are, which every program shows"));
    m_light->setObjectName(QStringLiteral("radiosityExportLight"));
    m_light->addItem(tr("At the vertices, divided as solved"));
    m_light->addItem(tr("In a light map"));
    form->addRow(tr("&Light"), m_light);
    m_size = withHelp(new QComboBox, tr("Side of the light map in texels"));
    m_size->setObjectName(QStringLiteral("radiosityExportSize"));
    for (int side = 256; side <= kMaxRadiosityMapSize; side *= 2)
        m_size->addItem(tr("%1 px").arg(side), side);
    m_size->setCurrentIndex(m_size->findData(RadiosityMapSettings().size));
    form->addRow(tr("Si&ze"), m_size);

    m_exposure = withHelp(
        new QComboBox, tr("How light of any brightness becomes colours: 1 - e^(-k L) with a k that "
                          "makes the median middle grey, or with yours, or cut off at 1"));
    m_exposure->setObjectName(QStringLiteral("radiosityExportExposure"));
    m_exposure->addItem(tr("Automatic"), static_cast<int>(ExposureRequest::Kind::Automatic));
    m_exposure->addItem(tr("Value of k"), static_cast<int>(ExposureRequest::Kind::Value));
    m_exposure->addItem(tr("None"), static_cast<int>(ExposureRequest::Kind::None));
    form->addRow(tr("&Exposure"), m_exposure);
    m_k = withHelp(new QDoubleSpinBox, tr("The k of 1 - e^(-k L)"));
    m_k->setObjectName(QStringLiteral("radiosityExportK"));
    m_k->setDecimals(4);
    m_k->setRange(1e-4, 1e6);
    m_k->setValue(1.0);
    form->addRow(tr("&k"), m_k);

    connect(m_intoOrigin, &QCheckBox::toggled, this, &RadiosityExportDialog::refresh);
    for (QComboBox* box : {m_light, m_size, m_exposure})
        connect(box, &QComboBox::currentIndexChanged, this, &RadiosityExportDialog::refresh);
    return widget;
}

bool RadiosityExportDialog::isLightMap() const {
    return m_light->currentIndex() == kLightMap && m_output->format() != kPly;
}

ExposureRequest RadiosityExportDialog::exposure() const {
    return {static_cast<ExposureRequest::Kind>(m_exposure->currentData().toInt()), m_k->value()};
}

void RadiosityExportDialog::refresh() {
    const int format = m_output->format();
    m_intoOrigin->setEnabled(format == kDae && !m_origin.file.empty());
    m_light->setEnabled(format != kPly); // which has no textures
    m_size->setEnabled(isLightMap());
    m_k->setEnabled(exposure().kind == ExposureRequest::Kind::Value);

    const QString path = m_output->path();
    const bool isOrigin = !path.isEmpty() && !m_origin.file.empty() &&
                          QFileInfo(path).canonicalFilePath() ==
                              QFileInfo(fromPath(m_origin.file)).canonicalFilePath();
    const LiveRadiosityPtr& live = m_radiosity.live();
    QString summary;
    if (!live) {
        summary = tr("There is no solution any more: close this, and solve the scene");
    } else if (isOrigin) {
        summary = tr("That is the scene's own file; choose another name");
    } else {
        summary = tr("%1 elements").arg(QLocale().toString(qulonglong(live->elements().size())));
        if (m_radiosity.step())
            summary += (m_radiosity.step()->unit == RadiosityStep::Shot
                            ? tr(", after %1 shots: as it is shown")
                            : tr(", after %1 sweeps: as it is shown"))
                           .arg(QLocale().toString(qulonglong(m_radiosity.step()->done)));
        else if (!live->solved)
            summary += tr(", not solved to the end yet");
        if (format == kGltf || isLightMap())
            summary += tr("; with files beside it");
        if (QFileInfo::exists(path))
            summary += tr("; the existing file will be overwritten");
    }
    const bool possible = live && !isOrigin && !path.isEmpty();
    const bool overwrites = possible && QFileInfo::exists(path);
    m_summary->setText(summary);
    m_summary->setStyleSheet(!possible || overwrites
                                 ? QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name())
                                 : QString());
    m_output->setRunnable(possible, overwrites ? tr("Overwrite") : tr("Export"));
}

void RadiosityExportDialog::run() {
    const radiosity::Solution* solution = m_radiosity.solution();
    if (solution == nullptr) {
        refresh(); // says why
        return;
    }
    auto work = std::make_shared<RadiosityExport>();
    work->document = m_controller.document();
    work->live = m_radiosity.live();
    work->solution = *solution;
    if (isLightMap())
        work->lightMapSize = m_size->currentData().toInt();
    work->exposure = exposure();
    work->files.output = toPath(m_output->path());
    if (m_intoOrigin->isEnabled() && m_intoOrigin->isChecked()) {
        work->files.document = m_origin.file;
        work->files.visualScene = m_origin.visualScene;
    }
    work->files.camera = m_controller.document().view.camera;
    rememberFolder(m_controller, QLatin1String(kExportFolderKey), m_output->path());
    m_jobs.start(
        tr("Export radiosity: %1").arg(shownFileName(m_output->path())), false,
        [work, worker = &m_controller.worker(),
         controller = &m_controller](const JobContext& job) -> JobOutcome {
            const Result<ExportPlan> plan = planOf(*work, job);
            if (!plan)
                return {plan.error(), {}, {}};
            const auto written = runExport(*worker, *plan, job);
            if (!written)
                return {written.error(), {}, {}};
            const QString file = fromPath(work->files.output);
            QStringList warnings;
            for (const std::string& warning : plan->warnings)
                warnings << QString::fromStdString(warning);
            return {std::nullopt, file, [controller, file, warnings] {
                        UserNotice notice;
                        notice.text =
                            RadiosityExportDialog::tr("Exported the radiosity to %1").arg(file);
                        notice.details = warnings;
                        Q_EMIT controller->noticed(notice);
                    }};
        });
    accept();
}

} // namespace patina::editor

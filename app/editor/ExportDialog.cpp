#include "app/editor/ExportDialog.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/edit/Edit.h"
#include "core/export/TransferExport.h"
#include "core/export/Variants.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QScrollArea>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

std::vector<OutputFile::Format> fileFormats() {
    std::vector<OutputFile::Format> formats;
    for (const ExportFormatInfo& info : exportFormats())
        formats.push_back({QString::fromUtf8(info.label), QString::fromUtf8(info.extension),
                           QString::fromUtf8(info.filter)});
    return formats;
}

// The name of the file that an embedded one lies in.
QString containerOf(const PlannedFile& file) {
    const QString name = fromPath(file.path.filename());
    return name.left(name.lastIndexOf(QLatin1Char('#')));
}

// As the list shows it: below the folder that is written to; its own name alone where it is part of
// another file, which the last column names.
QString shownName(const PlannedFile& file, const std::filesystem::path& folder) {
    const QString path = fromPath(file.path.lexically_relative(folder));
    if (path.isEmpty())
        return fromPath(file.path);
    return file.embedded ? path.section(QLatin1Char('#'), -1) : path;
}

} // namespace

ExportDialog::ExportDialog(DocumentController& controller, JobManager& jobs, QWidget* parent)
    : QDialog(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_output(new OutputFile(
          QStringLiteral("export"), fileFormats(),
          proposedFile(controller, QStringLiteral("folders/exports"), QStringLiteral(".glb")),
          *this)) {
    connect(m_output, &OutputFile::changed, this, &ExportDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &ExportDialog::run);
    setObjectName(QStringLiteral("exportDialog"));
    setWindowTitle(tr("Export"));
    resize(860, 560);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    layout->addWidget(makeSettings());

    auto* heading = new QLabel(tr("Files that will be written"));
    heading->setObjectName(QStringLiteral("heading"));
    layout->addWidget(heading);
    m_files = new QTableWidget(0, 5);
    m_files->setObjectName(QStringLiteral("exportFiles"));
    m_files->setAccessibleName(heading->text());
    m_files->setHorizontalHeaderLabels(
        {tr("File"), tr("Contents"), tr("Colour space"), tr("Format"), tr("Note")});
    m_files->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    // What does not fit ends in an ellipsis, and the tool tip has it.
    m_files->horizontalHeader()->setMinimumSectionSize(90);
    for (const int column : {0, 1, 4})
        m_files->horizontalHeader()->setSectionResizeMode(column, QHeaderView::Stretch);
    m_files->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    m_files->verticalHeader()->hide();
    m_files->setWordWrap(false); // a tool tip holds what does not fit
    m_files->setFocusPolicy(Qt::ClickFocus);
    m_files->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_files->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_files->setShowGrid(false);
    m_files->setAlternatingRowColors(true);
    // However many warnings there are, some files are in sight.
    m_files->setMinimumHeight(6 * m_files->verticalHeader()->defaultSectionSize());
    layout->addWidget(m_files, 3);
    m_warnings = new QLabel;
    m_warnings->setObjectName(QStringLiteral("exportWarnings"));
    m_warnings->setWordWrap(true);
    m_warnings->setStyleSheet(QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name()));
    m_warnings->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_warningsArea = new QScrollArea;
    m_warningsArea->setObjectName(QStringLiteral("exportWarningsArea"));
    m_warningsArea->setAccessibleName(tr("Warnings"));
    m_warningsArea->setFrameShape(QFrame::NoFrame);
    m_warningsArea->setWidgetResizable(true);
    m_warningsArea->setWidget(m_warnings);
    layout->addWidget(m_warningsArea, 1);

    m_output->addButtons(*layout, tr("Export"));
    refresh();
}

QWidget* ExportDialog::makeSettings() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);

    m_output->addFormatRow(*form, tr("One binary file, or a .gltf with its files beside it"));
    m_output->addFileRow(*form);
    m_textures = withHelp(new QComboBox, tr("PNG loses nothing, JPEG is smaller"));
    m_textures->addItem(tr("PNG"), static_cast<int>(ExportTextureFormat::Png));
    m_textures->addItem(tr("JPEG"), static_cast<int>(ExportTextureFormat::Jpeg));
    form->addRow(tr("&Textures"), m_textures);
    m_size = withHelp(new QComboBox, tr("Larger textures are reduced to this side length"));
    m_size->addItem(tr("Original size"), 0);
    for (const int side : {512, 1024, 2048, 4096})
        m_size->addItem(tr("At most %1 px").arg(side), side);
    form->addRow(tr("&Size"), m_size);

    m_bakedAo = withHelp(new QCheckBox(tr("Baked ambient occlusion as occlusion texture")),
                         tr("Uses the attached ambient occlusion texture bake, or the ambient "
                            "visibility of the light map"));
    m_transfer = withHelp(
        new QCheckBox(tr("Radiance transfer as vertex attributes _PRT_n")),
        tr("Uses the attached radiance transfer bake per vertex; writes the light as JSON and a "
           "shader that multiplies the two"));
    m_bands = withHelp(new QComboBox,
                       tr("Fewer bands take fewer vertex attributes and have softer shadows"));
    m_bands->setObjectName(QStringLiteral("exportBands"));
    m_transfer->setObjectName(QStringLiteral("exportTransfer"));
    m_bands->addItem(tr("All"), 0);
    const BakeArtifactPtr transfer = findBake(m_controller.document(), BakeKind::PrtVertex);
    for (int bands = transfer ? transferLayout(*transfer, 0).bands - 1 : 0; bands > 0; --bands)
        m_bands->addItem(tr("The first %1").arg(bands), bands);
    m_lightMap = withHelp(
        new QCheckBox(tr("Light map as EXR textures")),
        tr("Uses the attached light map bake; writes what is to be added to image-based light, its "
           "reflections and bent normals beside the file, and a shader that uses them"));
    m_lightMap->setObjectName(QStringLiteral("exportLightMap"));
    m_lights = withHelp(new QCheckBox(tr("Lights (KHR_lights_punctual)")),
                        tr("Writes point and directional lights"));
    m_variants = withHelp(
        new QCheckBox(tr("Snapshots as material variants (KHR_materials_variants)")),
        tr("Writes the materials of each snapshot, for programs that can switch between them"));
    m_visible = withHelp(new QCheckBox(tr("Visible meshes only")), tr("Leaves hidden meshes out"));
    m_environment = withHelp(
        new QCheckBox(tr("Environment's light (EXT_lights_image_based)")),
        tr("Writes the environment's light into the file; few programs read it, Babylon.js does"));
    m_environment->setObjectName(QStringLiteral("exportEnvironment"));
    m_visible->setObjectName(QStringLiteral("exportVisible"));
    for (QCheckBox* box :
         {m_bakedAo, m_transfer, m_lightMap, m_lights, m_environment, m_variants, m_visible}) {
        box->setChecked(box != m_environment && box != m_transfer); // few programs read those
        form->addRow(QString(), box);
        connect(box, &QCheckBox::toggled, this, &ExportDialog::refresh);
        if (box == m_transfer)
            form->addRow(tr("Transfer &bands"), m_bands);
    }
    // What no bake is there for is not asked.
    form->setRowVisible(m_bands, transfer != nullptr);
    form->setRowVisible(m_lightMap,
                        findBake(m_controller.document(), BakeKind::LightMap) != nullptr);
    form->setRowVisible(m_variants, hasMaterialVariants(m_controller.document()));
    connect(m_transfer, &QCheckBox::toggled, m_bands, &QWidget::setEnabled);
    m_bands->setEnabled(false);

    connect(m_bands, &QComboBox::currentIndexChanged, this, &ExportDialog::refresh);
    connect(m_textures, &QComboBox::currentIndexChanged, this, &ExportDialog::refresh);
    connect(m_size, &QComboBox::currentIndexChanged, this, &ExportDialog::refresh);
    return widget;
}

ExportSettings ExportDialog::settings() const {
    ExportSettings settings;
    settings.output = toPath(m_output->path());
    settings.format = exportFormats()[static_cast<std::size_t>(m_output->format())].format;
    settings.textures = static_cast<ExportTextureFormat>(m_textures->currentData().toInt());
    settings.maxTextureSize = m_size->currentData().toInt();
    settings.includeBakedAo = m_bakedAo->isChecked();
    settings.includeTransfer = m_transfer->isChecked();
    settings.transferBands = m_bands->currentData().toInt();
    settings.includeLightMap = m_lightMap->isChecked();
    settings.includeLights = m_lights->isChecked();
    settings.includeEnvironment = m_environment->isChecked();
    settings.includeVariants = m_variants->isChecked();
    settings.visibleOnly = m_visible->isChecked();
    return settings;
}

void ExportDialog::refresh() {
    m_plan = planExport(m_controller.document(), settings());
    const std::filesystem::path folder = m_plan.settings.output.parent_path();
    m_files->setRowCount(static_cast<int>(m_plan.files.size()));
    for (int row = 0; row < m_files->rowCount(); ++row) {
        const PlannedFile& file = m_plan.files[static_cast<std::size_t>(row)];
        const QStringList cells = {
            shownName(file, folder),
            QString::fromStdString(file.contents),
            QString::fromStdString(file.colorSpace),
            QString::fromStdString(file.format),
            file.overwrites ? tr("Overwrites")
            : file.embedded ? tr("Inside %1").arg(containerOf(file))
                            : tr("New"),
        };
        for (int column = 0; column < cells.size(); ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            item->setToolTip(column == 0 ? fromPath(file.path) : cells[column]);
            if (file.overwrites && column == 4)
                item->setForeground(QColor(tokens::kCopper));
            m_files->setItem(row, column, item);
        }
    }
    QStringList warnings;
    if (m_plan.problem)
        warnings << QString::fromStdString(m_plan.problem->message);
    for (const std::string& warning : m_plan.warnings)
        warnings << QString::fromStdString(warning);
    m_warnings->setText(warnings.join(QLatin1Char('\n')));
    m_warningsArea->setVisible(!warnings.isEmpty());
    const bool overwrites = std::any_of(m_plan.files.begin(), m_plan.files.end(),
                                        [](const PlannedFile& file) { return file.overwrites; });
    m_output->setRunnable(!m_plan.problem && !m_output->path().isEmpty(),
                          overwrites ? tr("Export and overwrite") : tr("Export"));
}

void ExportDialog::run() {
    // The plan holds the document as it was: editing goes on meanwhile.
    m_jobs.start(tr("Export: %1").arg(shownFileName(m_output->path())), false,
                 [plan = m_plan, worker = &m_controller.worker(),
                  controller = &m_controller](const JobContext& job) -> JobOutcome {
                     const auto written = runExport(*worker, plan, job);
                     if (!written)
                         return {written.error(), {}, {}};
                     const QString file = fromPath(plan.settings.output);
                     return {std::nullopt, file, [controller, file] {
                                 UserNotice notice;
                                 notice.text = ExportDialog::tr("Exported to %1").arg(file);
                                 Q_EMIT controller->noticed(notice);
                             }};
                 });
    accept();
}

} // namespace patina::editor

#include "app/editor/wall/SheetSaveDialog.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/SheetSave.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/OutputFile.h"
#include "core/sheet/SheetPictures.h"

#include <QCheckBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QVBoxLayout>
#include <optional>

namespace patina::editor {
namespace {

constexpr const char* kSheetFolderKey = "folders/sheets";
constexpr int kNarrowestCell = 32, kWidestCell = 4096;

QString sheetName(const DocumentController& controller) {
    return QFileInfo(controller.displayName()).completeBaseName();
}

} // namespace

SheetSaveDialog::SheetSaveDialog(const WallState& wall, ViewportWidget& viewport,
                                 DocumentController& controller, JobManager& jobs, QWidget* parent)
    : QDialog(parent)
    , m_wall(wall)
    , m_viewport(viewport)
    , m_controller(controller)
    , m_jobs(jobs)
    // In the order of SheetFormat.
    , m_output(new OutputFile(QStringLiteral("sheetSave"),
                              {{tr("PNG"), QStringLiteral("png"), QStringLiteral("PNG")},
                               {tr("JPEG"), QStringLiteral("jpg"), QStringLiteral("JPEG")},
                               {tr("TIFF"), QStringLiteral("tif"), QStringLiteral("TIFF")},
                               {tr("OpenEXR (linear, a part for each cell)"), QStringLiteral("exr"),
                                QStringLiteral("OpenEXR")},
                               {tr("PDF"), QStringLiteral("pdf"), QStringLiteral("PDF")}},
                              QDir(proposedFolder(controller, QLatin1String(kSheetFolderKey)))
                                  .filePath(tr("%1 sheet.png").arg(sheetName(controller))),
                              *this)) {
    setObjectName(QStringLiteral("sheetSaveDialog"));
    setWindowTitle(tr("Save Sheet As"));
    resize(620, 320);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    layout->addWidget(makeSettings());
    m_summary = new QLabel;
    m_summary->setObjectName(QStringLiteral("sheetSaveSummary"));
    m_summary->setWordWrap(true);
    layout->addWidget(m_summary);
    layout->addStretch(1);
    m_output->addButtons(*layout, tr("Save"));
    connect(m_output, &OutputFile::changed, this, &SheetSaveDialog::refresh);
    connect(m_output, &OutputFile::accepted, this, &SheetSaveDialog::run);
    refresh();
}

void SheetSaveDialog::open(const WallState& wall, ViewportWidget& viewport,
                           DocumentController& controller, JobManager& jobs, QWidget* parent) {
    auto* dialog = new SheetSaveDialog(wall, viewport, controller, jobs, parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

QWidget* SheetSaveDialog::makeSettings() {
    auto* widget = new QWidget;
    auto* form = new QFormLayout(widget);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(20);
    form->setVerticalSpacing(tokens::kGap);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    m_output->addFormatRow(
        *form, tr("PNG, JPEG, TIFF and PDF show the sheet as on screen; OpenEXR keeps each cell's "
                  "linear values, without captions"));
    m_width = withHelp(new QSpinBox,
                       tr("Width of a cell in pixels; its height follows from what is on screen"));
    m_width->setObjectName(QStringLiteral("sheetSaveWidth"));
    m_width->setRange(kNarrowestCell, kWidestCell);
    m_width->setSingleStep(64);
    m_width->setValue(SheetOrder().cellWidth);
    m_width->setSuffix(tr(" px"));
    form->addRow(tr("Cell &width"), m_width);
    m_captions = withHelp(new QCheckBox(tr("Title and captions")),
                          tr("Writes above the cells what they show"));
    m_captions->setObjectName(QStringLiteral("sheetSaveCaptions"));
    m_captions->setChecked(true);
    form->addRow(QString(), m_captions);
    m_title = withHelp(new QLineEdit(sheetName(m_controller)), tr("Above the cells"));
    m_title->setObjectName(QStringLiteral("sheetSaveTitle"));
    form->addRow(tr("&Title"), m_title);
    m_output->addFileRow(*form);
    connect(m_width, &QSpinBox::valueChanged, this, &SheetSaveDialog::refresh);
    connect(m_captions, &QCheckBox::toggled, this, &SheetSaveDialog::refresh);
    connect(m_title, &QLineEdit::textChanged, this, &SheetSaveDialog::refresh);
    return widget;
}

void SheetSaveDialog::refresh() {
    const auto format = static_cast<SheetFormat>(m_output->format());
    const bool parts = format == SheetFormat::Exr;
    m_captions->setEnabled(!parts);
    m_title->setEnabled(!parts && m_captions->isChecked());
    const QSize cell = m_viewport.wallPainter().sheetCellSize(m_width->value());
    const std::size_t count = m_wall.cells().size();
    std::optional<Error> error;
    QString summary;
    if (count == 0 || cell.isEmpty()) {
        summary = tr("There is no wall to save.");
    } else if (parts) {
        if (const auto fits = sheet::checkPartsFit(count, cell.width(), cell.height()); !fits)
            error = fits.error();
        summary = tr("%1 parts of %2 × %3 pixels").arg(count).arg(cell.width()).arg(cell.height());
    } else {
        std::optional<sheet::WallSheetText> text;
        if (m_captions->isChecked())
            text = {m_title->text().toStdString(),
                    sheet::commonText(m_wall.wall(), m_controller.document())};
        const Result<sheet::WallSheet> paper =
            sheet::WallSheet::create(m_wall.wall(), cell.width(), cell.height(), text);
        if (paper)
            summary = tr("%1 cells of %2 × %3 pixels; %4 × %5 in all")
                          .arg(count)
                          .arg(cell.width())
                          .arg(cell.height())
                          .arg(paper->size().x)
                          .arg(paper->size().y);
        else
            error = paper.error();
    }
    const bool named = !m_output->path().isEmpty();
    const bool possible = count > 0 && !cell.isEmpty() && !error && named;
    const bool overwrites = possible && QFileInfo::exists(m_output->path());
    if (error)
        summary = UserNotice::fromError(*error).text;
    else if (!named)
        summary = tr("Choose a file.");
    else if (overwrites)
        summary += tr("; the existing file will be overwritten");
    m_summary->setText(summary);
    m_summary->setStyleSheet(overwrites || !possible
                                 ? QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name())
                                 : QString());
    m_output->setRunnable(possible, overwrites ? tr("Overwrite") : tr("Save"));
}

void SheetSaveDialog::run() {
    rememberFolder(m_controller, QLatin1String(kSheetFolderKey), m_output->path());
    SheetOrder order;
    order.file = QFileInfo(m_output->path()).absoluteFilePath();
    order.format = static_cast<SheetFormat>(m_output->format());
    order.cellWidth = m_width->value();
    order.captions = m_captions->isChecked();
    order.title = m_title->text();
    new SheetSave(std::move(order), m_wall, m_viewport, m_controller, m_jobs);
    accept();
}

} // namespace patina::editor

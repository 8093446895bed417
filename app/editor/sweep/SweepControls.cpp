#include "app/editor/sweep/SweepControls.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/sweep/SweepWork.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/LabelledField.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/TextButton.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QToolButton>

namespace patina::editor {
namespace {

constexpr const char* kSweepFolder = "sweep/folder";
constexpr int kMostShownRotations = 360; // a degree each; more no table nor strip makes use of
constexpr int kFolderWidth = 140;        // of its name, at most

} // namespace

SweepControls::SweepControls(DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_folder(QSettings().value(QLatin1String(kSweepFolder)).toString())
    , m_ofDocument(describe(new QCheckBox(tr("Scene")), tr("Scene's environments"),
                            tr("Sweep the environments of the scene")))
    , m_shipped(describe(new QCheckBox(tr("Built-in skies")), tr("Built-in skies"),
                         tr("Sweep the skies that come with Patina")))
    , m_ofFolder(new QCheckBox)
    , m_rotations(describe(new QSpinBox, tr("Rotations"),
                           tr("How many rotations of each environment are looked at, evenly "
                              "spaced from 0°")))
    , m_by(describe(new QComboBox, tr("Rank by"), tr("What makes a light a bad one")))
    , m_reference(describe(new QComboBox, tr("Compare with"),
                           tr("The look that contrast and difference are measured from; the "
                              "scene's light is then swept, too")))
    , m_start(makeTextButton(tr("Start"), {})) {
    m_ofDocument->setChecked(true);
    m_shipped->setChecked(true);
    m_rotations->setRange(1, kMostShownRotations);
    m_rotations->setValue(SweepOrder().rotations);
    m_by->addItem(tr("Difference"), static_cast<int>(RankBy::Difference));
    m_by->addItem(tr("Clipped pixels"), static_cast<int>(RankBy::Clipping));
    m_by->addItem(tr("Lost contrast"), static_cast<int>(RankBy::Contrast));
    m_reference->addItem(tr("Mean look"), false);
    m_reference->addItem(tr("Scene's light"), true);
    m_start->setProperty("primary", true);
    m_start->setObjectName(QStringLiteral("sweepStart"));

    QToolButton* browseButton = makeListButton(
        QStringLiteral("open"), {}, tr("Choose a folder of HDR and EXR environments to sweep"));
    auto* folder = new QWidget;
    auto* row = new QHBoxLayout(folder);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap / 2);
    row->addWidget(m_ofFolder);
    row->addWidget(browseButton);

    auto* flow = new FlowLayout(tokens::kMargin, tokens::kGap / 2, this);
    flow->setContentsMargins(0, 0, 0, 0);
    for (QWidget* item :
         {static_cast<QWidget*>(m_ofDocument), static_cast<QWidget*>(m_shipped), folder,
          labelledField(tr("Rotations"), m_rotations), labelledField(tr("Rank by"), m_by),
          labelledField(tr("Compare with"), m_reference), static_cast<QWidget*>(m_start)})
        flow->addWidget(item);

    connect(browseButton, &QToolButton::clicked, this, &SweepControls::browse);
    connect(m_by, &QComboBox::currentIndexChanged, this, &SweepControls::byChanged);
    for (QCheckBox* box : {m_ofDocument, m_shipped, m_ofFolder})
        connect(box, &QCheckBox::toggled, this, &SweepControls::refresh);
    connect(m_start, &QPushButton::clicked, this,
            [this] { m_running ? Q_EMIT cancelWanted() : Q_EMIT startWanted(); });
    showFolder();
    refresh();
}

void SweepControls::fill(SweepOrder& order) const {
    order.ofDocument = m_ofDocument->isChecked();
    order.shipped = m_shipped->isChecked();
    order.folder.clear();
    if (m_ofFolder->isChecked())
        order.folder = toPath(m_folder);
    order.rotations = m_rotations->value();
    order.comparesWithScene = m_reference->currentData().toBool();
}

RankBy SweepControls::by() const {
    return static_cast<RankBy>(m_by->currentData().toInt());
}

void SweepControls::setFolder(const QString& folder) {
    m_folder = folder;
    QSettings().setValue(QLatin1String(kSweepFolder), folder);
    showFolder();
    m_ofFolder->setChecked(true);
}

void SweepControls::add(QWidget* more) {
    layout()->addWidget(more);
}

void SweepControls::browse() {
    auto* dialog =
        new QFileDialog(window(), tr("Choose a Folder of Environments"),
                        QDir(m_folder).exists() && !m_folder.isEmpty()
                            ? m_folder
                            : proposedFolder(m_controller, QStringLiteral("folders/environments")));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly, false); // it shows what is in them
    connect(dialog, &QFileDialog::fileSelected, this, &SweepControls::setFolder);
    dialog->open();
}

void SweepControls::showFolder() {
    const bool known = !m_folder.isEmpty();
    const QString name = QDir(m_folder).dirName();
    m_ofFolder->setText(
        known ? tr("Folder %1")
                    .arg(m_ofFolder->fontMetrics().elidedText(name, Qt::ElideMiddle, kFolderWidth))
              : tr("Folder"));
    describe(m_ofFolder, tr("Folder"),
             known ? tr("Sweep the HDR and EXR environments of %1").arg(m_folder)
                   : tr("Sweep the HDR and EXR environments of a folder; choose it first"));
    m_ofFolder->setEnabled(known && !m_running);
}

void SweepControls::setRunning(bool running) {
    m_running = running;
    refresh();
}

void SweepControls::refresh() {
    const bool some =
        m_ofDocument->isChecked() || m_shipped->isChecked() || m_ofFolder->isChecked();
    m_start->setText(m_running ? tr("Cancel") : tr("Start"));
    describe(m_start, m_start->text(),
             m_running ? tr("Cancel the sweep; the result before it stays")
             : some    ? tr("Light the scene by every environment and rotation, and rank them")
                       : tr("Choose the scene's environments, the built-in skies or a folder "
                               "first"));
    m_start->setEnabled(m_running || some);
}

} // namespace patina::editor

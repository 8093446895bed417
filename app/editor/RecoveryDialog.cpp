#include "app/editor/RecoveryDialog.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "core/base/AtomicFile.h"
#include "core/base/Limits.h"
#include "core/edit/DocumentDifference.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"

#include <QDateTime>
#include <QFile>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr QSize kPictureSize(352, 220);
constexpr int kListWidth = 220;

QString timeText(std::int64_t seconds) {
    const QDateTime time = QDateTime::fromSecsSinceEpoch(seconds);
    const QString clock = QLocale().toString(time.time(), QLocale::ShortFormat);
    const qint64 days = time.date().daysTo(QDate::currentDate());
    if (days == 0)
        return RecoveryDialog::tr("today, %1").arg(clock);
    if (days == 1)
        return RecoveryDialog::tr("yesterday, %1").arg(clock);
    return QStringLiteral("%1, %2").arg(QLocale().toString(time.date(), QLocale::ShortFormat),
                                        clock);
}

// "1 mesh", "3 meshes": without a translation Qt would write "mesh(es)".
QString counted(int count, const QString& one, const QString& many) {
    return QStringLiteral("%1 %2").arg(count).arg(count == 1 ? one : many);
}

QPixmap pictureIn(const std::filesystem::path& file, double ratio) {
    QPixmap picture;
    if (!picture.load(fromPath(file), "PNG"))
        return {};
    picture = picture.scaled(kPictureSize * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation);
    picture.setDevicePixelRatio(ratio);
    return picture;
}

QLabel* pictureLabel(const QString& name) {
    auto* label = new QLabel;
    label->setObjectName(name);
    label->setFixedSize(kPictureSize);
    label->setAlignment(Qt::AlignCenter);
    label->setStyleSheet(QStringLiteral("background: %1").arg(QColor(tokens::kWell).name()));
    return label;
}

void showPicture(QLabel* label, const QPixmap& picture) {
    if (picture.isNull())
        label->setText(RecoveryDialog::tr("No picture was kept"));
    else
        label->setPixmap(picture);
}

QLabel* wrapped(const QString& name) {
    auto* label = new QLabel;
    label->setObjectName(name);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText); // names come from files
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    return label;
}

} // namespace

RecoveryDialog::RecoveryDialog(std::vector<AbandonedWork> works, QWidget* parent)
    : QDialog(parent)
    , m_works(std::move(works)) {
    setObjectName(QStringLiteral("recoveryDialog"));
    setWindowTitle(tr("Recover Unsaved Work"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    auto* heading = new QLabel(
        m_works.size() == 1 ? tr("Patina closed unexpectedly. Recover this unsaved work?")
                            : tr("Patina closed unexpectedly. Recover these unsaved works?"));
    heading->setObjectName(QStringLiteral("heading"));
    layout->addWidget(heading);

    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kMargin);
    m_list = new QListWidget;
    m_list->setObjectName(QStringLiteral("recoveryList"));
    m_list->setAccessibleName(tr("Unsaved work"));
    m_list->setFixedWidth(kListWidth);
    m_list->setTextElideMode(Qt::ElideMiddle);
    for (const AbandonedWork& work : m_works)
        m_list->addItem(QStringLiteral("%1\n%2").arg(shownName(toQString(work.record.name)),
                                                     timeText(work.record.writtenAt)));
    m_list->setVisible(m_works.size() > 1);
    row->addWidget(m_list);
    row->addWidget(makeDetails(), 1);
    layout->addLayout(row);
    layout->addWidget(makeComparison(), 1);

    auto* buttons = new QHBoxLayout;
    m_discard = new QPushButton(tr("&Discard…"));
    m_discard->setToolTip(tr("Deletes this unsaved work. The saved file stays as it is"));
    m_compare = new QPushButton(tr("&Compare with Saved"));
    m_compare->setCheckable(true);
    auto* later = new QPushButton(tr("&Later"));
    later->setToolTip(tr("Keeps the unsaved work. File › Recover Unsaved Work shows it again"));
    m_recover = new QPushButton(tr("&Recover"));
    m_recover->setToolTip(tr("Opens the unsaved work. The saved file changes only when you save"));
    m_recover->setDefault(true);
    buttons->addWidget(m_discard);
    buttons->addStretch(1);
    buttons->addWidget(m_compare);
    buttons->addWidget(later);
    buttons->addWidget(m_recover);
    layout->addLayout(buttons);
    for (QPushButton* button : {m_discard, m_compare, later, m_recover})
        button->setAccessibleName(button->text().remove(QLatin1Char('&')));
    connect(m_discard, &QPushButton::clicked, this, &RecoveryDialog::discard);
    connect(m_compare, &QPushButton::toggled, this, &RecoveryDialog::compare);
    connect(later, &QPushButton::clicked, this, &QDialog::reject);
    connect(m_recover, &QPushButton::clicked, this, &RecoveryDialog::recoverRequested);
    connect(m_list, &QListWidget::currentRowChanged, this, &RecoveryDialog::showCurrent);
    m_list->setCurrentRow(0);
    showCurrent();
    m_recover->setFocus();
}

RecoveryDialog::~RecoveryDialog() = default;

QWidget* RecoveryDialog::makeDetails() {
    auto* widget = new QWidget;
    auto* layout = new QVBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    m_title = wrapped(QStringLiteral("recoveryTitle"));
    QFont font = m_title->font();
    font.setBold(true);
    m_title->setFont(font);
    m_facts = wrapped(QStringLiteral("recoveryFacts"));
    m_leftOut = wrapped(QStringLiteral("recoveryLeftOut"));
    m_leftOut->setStyleSheet(QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name()));

    auto* pictures = new QGridLayout;
    pictures->setHorizontalSpacing(tokens::kMargin);
    m_picture = pictureLabel(QStringLiteral("recoveryPicture"));
    m_savedPicture = pictureLabel(QStringLiteral("recoverySavedPicture"));
    m_pictureName = new QLabel(tr("Unsaved work"));
    m_savedPictureName = new QLabel(tr("Saved"));
    for (QLabel* name : {m_pictureName, m_savedPictureName})
        name->setObjectName(QStringLiteral("dim"));
    pictures->addWidget(m_savedPicture, 0, 0);
    pictures->addWidget(m_picture, 0, 1);
    pictures->addWidget(m_savedPictureName, 1, 0);
    pictures->addWidget(m_pictureName, 1, 1);
    pictures->setColumnStretch(2, 1);
    layout->addWidget(m_title);
    layout->addLayout(pictures);
    layout->addWidget(m_facts);
    layout->addWidget(m_leftOut);
    layout->addStretch(1);
    return widget;
}

QWidget* RecoveryDialog::makeComparison() {
    auto* widget = new QWidget;
    auto* layout = new QVBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    m_summary = wrapped(QStringLiteral("recoverySummary"));
    m_table = new QTableWidget(0, 4);
    m_table->setObjectName(QStringLiteral("recoveryDifferences"));
    m_table->setAccessibleName(tr("Differences"));
    m_table->setHorizontalHeaderLabels({tr("Where"), tr("Value"), tr("Saved"), tr("Unsaved work")});
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    m_table->verticalHeader()->hide();
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setAlternatingRowColors(true);
    m_table->setShowGrid(false);
    m_table->setMinimumHeight(160);
    layout->addWidget(m_summary);
    layout->addWidget(m_table, 1);
    m_summary->hide();
    m_table->hide();
    return widget;
}

std::size_t RecoveryDialog::current() const {
    return static_cast<std::size_t>(std::max(m_list->currentRow(), 0));
}

AbandonedWork RecoveryDialog::takeCurrent() {
    const std::size_t index = current();
    AbandonedWork taken = std::move(m_works[index]);
    remove(index);
    return taken;
}

void RecoveryDialog::remove(std::size_t index) {
    const QSignalBlocker blocker(m_list);
    m_works.erase(m_works.begin() + static_cast<std::ptrdiff_t>(index));
    delete m_list->takeItem(static_cast<int>(index));
}

void RecoveryDialog::showCurrent() {
    if (m_works.empty())
        return;
    const RecoveryRecord& record = work().record;
    m_title->setText(shownName(toQString(record.name)));
    QStringList facts;
    facts << (record.file.empty() ? tr("It was never saved.")
                                  : tr("Saved as %1").arg(shownName(fromPath(record.file))));
    facts << tr("Last changed %1; unsaved since %2")
                 .arg(timeText(record.writtenAt), timeText(record.unsavedSince));
    facts << tr("%1, %2, %3")
                 .arg(counted(record.meshes, tr("mesh"), tr("meshes")),
                      counted(record.materials, tr("material"), tr("materials")),
                      counted(record.lights, tr("light"), tr("lights")));
    if (record.steps > 0)
        facts << tr("%1; the last one: %2")
                     .arg(counted(record.steps, tr("unsaved step"), tr("unsaved steps")),
                          shownName(toQString(record.lastStep)));
    facts << tr("Undo steps are not recovered.");
    m_facts->setText(facts.join(QLatin1Char('\n')));
    QStringList leftOut;
    for (const std::string& text : record.leftOut)
        leftOut << tr("Not kept: %1").arg(shownName(toQString(text)));
    m_leftOut->setText(leftOut.join(QLatin1Char('\n')));
    m_leftOut->setVisible(!leftOut.isEmpty());
    m_compare->setEnabled(!record.file.empty());
    m_compare->setToolTip(record.file.empty()
                              ? tr("This work was never saved: there is nothing to compare with")
                              : tr("Shows what differs from the saved file, value by value"));
    if (record.file.empty())
        m_compare->setChecked(false);
    showPictures();
    fillDifferences();
}

void RecoveryDialog::showPictures() {
    const bool both = m_compare->isChecked();
    const double ratio = devicePixelRatioF();
    showPicture(m_picture, pictureIn(work().session->pictureFile(), ratio));
    showPicture(m_savedPicture, pictureIn(work().session->savedPictureFile(), ratio));
    m_savedPicture->setVisible(both);
    m_savedPictureName->setVisible(both);
    m_pictureName->setVisible(both);
}

// --- Compare with saved --------------------------------------------------------------------------

void RecoveryDialog::compare(bool shown) {
    m_summary->setVisible(shown);
    m_table->setVisible(shown);
    showPictures();
    fillDifferences();
    QMetaObject::invokeMethod(this, &QWidget::adjustSize, Qt::QueuedConnection);
}

void RecoveryDialog::fillDifferences() {
    m_table->setRowCount(0);
    const RecoveryRecord& record = work().record;
    if (!m_compare->isChecked())
        return;
    const Result<std::string> text = readTextFile(record.file, limits::kMaxProjectFileBytes);
    const Result<Document> saved =
        text ? documentFromJson(*text, record.file) : Result<Document>(text.error());
    const Result<Document> unsaved = documentFromJson(record.project, record.projectFile());
    if (!saved || !unsaved) {
        const Error& error = !saved ? saved.error() : unsaved.error();
        m_summary->setText(
            tr("They cannot be compared: %1").arg(shownName(toQString(error.text()))));
        return;
    }
    const std::vector<DocumentDifference> found = differences(*saved, *unsaved);
    QString summary = found.empty() ? tr("All values are those of the saved file.")
                                    : tr("%1 from the saved file:")
                                          .arg(counted(static_cast<int>(found.size()),
                                                       tr("difference"), tr("differences")));
    if (hashFile(record.file) != record.savedContent)
        summary += QLatin1Char(' ') + tr("The saved file was changed since this work was begun.");
    m_summary->setText(summary);
    m_table->setRowCount(static_cast<int>(found.size()));
    int line = 0;
    for (const DocumentDifference& difference : found) {
        int column = 0;
        for (const std::string* part :
             {&difference.element, &difference.value, &difference.before, &difference.after}) {
            auto* item = new QTableWidgetItem(shownName(toQString(*part)));
            item->setToolTip(item->text());
            m_table->setItem(line, column++, item);
        }
        ++line;
    }
}

// --- Discard -------------------------------------------------------------------------------------

void RecoveryDialog::discard() {
    auto* question = new QMessageBox(
        QMessageBox::Warning, tr("Discard Unsaved Work"),
        tr("Discard the unsaved work on %1?").arg(shownName(toQString(work().record.name))),
        QMessageBox::Discard | QMessageBox::Cancel, this);
    question->setIconPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                                .pixmap(QSize(36, 36), devicePixelRatioF()));
    question->setInformativeText(tr("It cannot be brought back. The saved file stays as it is."));
    question->setDefaultButton(QMessageBox::Cancel);
    question->setAttribute(Qt::WA_DeleteOnClose);
    connect(question, &QMessageBox::finished, this, [this](int answer) {
        if (answer != QMessageBox::Discard)
            return;
        const std::size_t index = current();
        m_works[index].session->clear();
        remove(index);
        if (m_works.empty())
            accept();
        else
            showCurrent();
    });
    question->open();
}

} // namespace patina::editor

#include "app/editor/panel/JobRow.h"

#include "app/editor/panel/JobTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/TextButton.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>
#include <QProgressBar>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

QPushButton* makeButton(const QString& text, const QString& help, const QString& title) {
    QPushButton* button = makeTextButton(text, help);
    button->setAccessibleName(QStringLiteral("%1 %2").arg(text, title));
    return button;
}

constexpr double kMuchSeconds = 60.0;

} // namespace

bool cancelLosesMuch(const JobRecord& record) {
    return !record.ended() && record.begun && record.canStop &&
           record.progress.secondsSoFar > kMuchSeconds;
}

JobRow::JobRow(JobManager& jobs, const JobRecord& record, const QString& names, QWidget* parent)
    : QWidget(parent)
    , m_jobs(jobs)
    , m_record(record) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, tokens::kGap);
    layout->setSpacing(tokens::kGap / 2);
    auto* title = new QLabel(record.title);
    title->setWordWrap(true);
    m_bar = new QProgressBar;
    m_bar->setRange(0, 1000);
    m_bar->setTextVisible(false); // the words stand below
    m_bar->setAccessibleName(tr("Progress of %1").arg(record.title));
    m_text = new QLabel;
    m_text->setObjectName(QStringLiteral("dim"));
    m_text->setWordWrap(true);

    m_pause = makeButton(tr("Pause"), {}, record.title);
    m_pause->setObjectName(names + QStringLiteral("Pause"));
    m_stop = makeButton(tr("Stop"), tr("Ends now and keeps what has converged"), record.title);
    m_stop->setObjectName(names + QStringLiteral("Stop"));
    m_cancel = makeButton(tr("Cancel"), tr("Ends now and keeps nothing"), record.title);
    m_cancel->setObjectName(names + QStringLiteral("Cancel"));
    m_priority = new QComboBox;
    m_priority->addItem(tr("Low"), static_cast<int>(JobPriority::Low));
    m_priority->addItem(tr("Normal"), static_cast<int>(JobPriority::Normal));
    m_priority->addItem(tr("High"), static_cast<int>(JobPriority::High));
    m_priority->setObjectName(names + QStringLiteral("Priority"));
    m_priority->setAccessibleName(tr("Priority of %1").arg(record.title));
    m_priority->setToolTip(
        tr("Priority: the highest goes first; a running one of lower priority is paused"));
    auto* head = new QHBoxLayout;
    head->addWidget(title, 1);
    head->addWidget(m_priority, 0, Qt::AlignTop);
    auto* buttons = new QHBoxLayout;
    for (QPushButton* button : {m_pause, m_stop, m_cancel})
        buttons->addWidget(button);
    buttons->addStretch(1);
    layout->addLayout(head);
    layout->addWidget(m_bar);
    layout->addWidget(m_text);
    layout->addLayout(buttons);

    connect(m_stop, &QPushButton::clicked, this, [this] { m_jobs.stop(m_record.id); });
    connect(m_cancel, &QPushButton::clicked, this, &JobRow::cancel);
    connect(m_pause, &QPushButton::clicked, this, [this] {
        if (m_record.state == JobState::Paused)
            m_jobs.resume(m_record.id);
        else
            m_jobs.pause(m_record.id);
    });
    connect(m_priority, &QComboBox::activated, this, [this] {
        m_jobs.setPriority(m_record.id,
                           static_cast<JobPriority>(m_priority->currentData().toInt()));
    });
    show(record);
}

void JobRow::show(const JobRecord& record) {
    m_record = record;
    const bool live = !record.ended();
    if (!live && m_question)
        m_question->close();
    m_bar->setVisible(live && record.begun);
    m_bar->setValue(static_cast<int>(record.progress.fraction * 1000.0));
    m_text->setText(stateText(record));
    const bool paused = record.state == JobState::Paused;
    m_pause->setVisible(live && record.queued && !record.stopping);
    m_pause->setText(paused ? tr("Resume") : tr("Pause"));
    m_pause->setToolTip(paused ? tr("Queues this job again; it resumes where it was paused")
                               : tr("Pauses this job and starts the next one"));
    m_stop->setVisible(live && record.canStop && record.begun && !record.stopping);
    m_cancel->setVisible(live && !record.cancelling);
    m_priority->setVisible(live && record.queued && !record.stopping);
    m_priority->setCurrentIndex(m_priority->findData(static_cast<int>(record.priority)));
}

void JobRow::cancel() {
    if (!cancelLosesMuch(m_record)) {
        m_jobs.cancel(m_record.id);
        return;
    }
    if (m_question) {
        m_question->raise();
        return;
    }
    m_question = new QMessageBox(QMessageBox::Question, tr("Cancel Job"),
                                 tr("Discard what %1 of work has computed?")
                                     .arg(durationText(m_record.progress.secondsSoFar)),
                                 QMessageBox::NoButton, this);
    m_question->setObjectName(QStringLiteral("cancelQuestion"));
    m_question->setInformativeText(
        tr("“Stop and Keep” ends it now and keeps what has converged; it can be resumed later."));
    QPushButton* stop = m_question->addButton(tr("&Stop and Keep"), QMessageBox::AcceptRole);
    QPushButton* discard = m_question->addButton(tr("&Discard"), QMessageBox::DestructiveRole);
    m_question->addButton(tr("&Keep Running"), QMessageBox::RejectRole);
    m_question->setDefaultButton(stop);
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    connect(stop, &QPushButton::clicked, this, [this] { m_jobs.stop(m_record.id); });
    connect(discard, &QPushButton::clicked, this, [this] { m_jobs.cancel(m_record.id); });
    m_question->open();
}

} // namespace patina::editor

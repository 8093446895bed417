#include "app/editor/panel/JobsPanel.h"

#include "app/editor/job/JobManager.h"
#include "app/editor/panel/JobTexts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr int kPollMs = 33;

QString stateText(const JobRecord& record) {
    switch (record.state) {
    case JobState::Running:
        return progressText(record);
    case JobState::Done:
        return JobsPanel::tr("Done in %1. %2")
            .arg(durationText(record.progress.secondsSoFar), record.summary);
    case JobState::Stopped:
        return JobsPanel::tr("Stopped. Kept: %1").arg(record.summary);
    case JobState::Cancelled:
        return record.summary;
    case JobState::Failed:
        break;
    }
    return JobsPanel::tr("Failed: %1").arg(record.summary);
}

} // namespace

JobsPanel::JobsPanel(JobManager& jobs, QWidget* parent)
    : QWidget(parent)
    , m_jobs(jobs) {
    setObjectName(QStringLiteral("jobsPanel"));
    auto* layout = new QVBoxLayout(this);
    auto* content = new QWidget;
    m_rows = new QVBoxLayout(content);
    m_rows->setContentsMargins(0, 0, 0, 0);
    m_empty = new QLabel(tr("Nothing is running. Bakes and exports appear here."));
    m_empty->setObjectName(QStringLiteral("dim"));
    m_empty->setWordWrap(true);
    m_rows->addWidget(m_empty);
    m_rows->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    layout->addWidget(scroll, 1);
    m_clear = new QPushButton(tr("Clear finished"));
    m_clear->setToolTip(tr("Removes jobs that have ended from this list"));
    m_clear->setAccessibleName(m_clear->text());
    connect(m_clear, &QPushButton::clicked, &jobs, &JobManager::clearFinished);
    layout->addWidget(m_clear, 0, Qt::AlignRight);

    m_timer.setInterval(kPollMs);
    connect(&m_timer, &QTimer::timeout, this, &JobsPanel::poll);
    connect(&jobs, &JobManager::jobsChanged, this, &JobsPanel::rebuild);
    rebuild();
}

JobsPanel::Row JobsPanel::makeRow(const JobRecord& record) {
    Row row{};
    row.widget = new QWidget;
    auto* layout = new QVBoxLayout(row.widget);
    layout->setContentsMargins(0, 0, 0, 8);
    row.title = new QLabel(record.title);
    row.title->setWordWrap(true);
    row.bar = new QProgressBar;
    row.bar->setRange(0, 1000);
    row.bar->setTextVisible(false);
    row.bar->setAccessibleName(tr("Progress of %1").arg(record.title));
    row.text = new QLabel;
    row.text->setObjectName(QStringLiteral("dim"));
    row.text->setWordWrap(true);
    row.stop = new QPushButton(tr("Stop"));
    row.stop->setToolTip(tr("Ends now and keeps what has converged"));
    row.stop->setAccessibleName(tr("Stop %1").arg(record.title));
    row.cancel = new QPushButton(tr("Cancel"));
    row.cancel->setToolTip(tr("Ends now and keeps nothing"));
    row.cancel->setAccessibleName(tr("Cancel %1").arg(record.title));
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(row.text, 1);
    buttons->addWidget(row.stop);
    buttons->addWidget(row.cancel);
    layout->addWidget(row.title);
    layout->addWidget(row.bar);
    layout->addLayout(buttons);
    connect(row.stop, &QPushButton::clicked, this, [this, id = record.id] { m_jobs.stop(id); });
    connect(row.cancel, &QPushButton::clicked, this, [this, id = record.id] { m_jobs.cancel(id); });
    return row;
}

void JobsPanel::show(const Row& row, const JobRecord& record) {
    const bool running = record.state == JobState::Running;
    row.bar->setVisible(running);
    row.bar->setValue(static_cast<int>(record.progress.fraction * 1000.0));
    row.text->setText(stateText(record));
    row.stop->setVisible(running && record.canStop);
    row.cancel->setVisible(running);
}

void JobsPanel::rebuild() {
    const std::vector<JobRecord> jobs = m_jobs.jobs();
    std::erase_if(m_shown, [&](const auto& shown) {
        for (const JobRecord& record : jobs)
            if (record.id == shown.first)
                return false;
        shown.second.widget->deleteLater();
        return true;
    });
    bool anyFinished = false;
    for (const JobRecord& record : jobs) {
        anyFinished |= record.state != JobState::Running;
        auto found = m_shown.find(record.id);
        if (found == m_shown.end()) {
            found = m_shown.emplace(record.id, makeRow(record)).first;
            m_rows->insertWidget(0, found->second.widget); // newest on top
        }
        show(found->second, record);
    }
    m_empty->setVisible(jobs.empty());
    m_clear->setEnabled(anyFinished);
    if (m_jobs.runningCount() > 0)
        m_timer.start();
    else
        m_timer.stop();
}

void JobsPanel::poll() {
    for (const JobRecord& record : m_jobs.jobs())
        if (const auto found = m_shown.find(record.id); found != m_shown.end())
            show(found->second, record);
}

} // namespace patina::editor

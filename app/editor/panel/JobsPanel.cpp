#include "app/editor/panel/JobsPanel.h"

#include "app/editor/job/JobManager.h"
#include "app/editor/panel/JobRow.h"
#include "app/editor/widget/EditControl.h"

#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kJobsPollMs = 100;

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
    constexpr int kLines = 7; // a job from its title to its buttons
    scroll->setMinimumHeight(kLines * fontMetrics().height());
    layout->addWidget(scroll, 1);
    m_clear = new QPushButton(tr("Clear finished"));
    m_clear->setToolTip(tr("Removes jobs that have ended from this list"));
    m_clear->setAccessibleName(m_clear->text());
    connect(m_clear, &QPushButton::clicked, &jobs, &JobManager::clearFinished);
    layout->addWidget(m_clear, 0, Qt::AlignRight);

    m_timer.setInterval(kJobsPollMs);
    connect(&m_timer, &QTimer::timeout, this, &JobsPanel::poll);
    connect(&jobs, &JobManager::jobsChanged, this, &JobsPanel::rebuild);
    rebuild();
}

void JobsPanel::rebuild() {
    const std::vector<JobRecord> jobs = m_jobs.jobs();
    std::erase_if(m_shown, [&](const auto& shown) {
        const bool gone = std::ranges::find(jobs, shown.first, &JobRecord::id) == jobs.end();
        if (gone)
            retire(shown.second);
        return gone;
    });
    for (const JobRecord& record : jobs) {
        JobRow*& row = m_shown[record.id];
        if (row == nullptr) {
            row = new JobRow(m_jobs, record, QStringLiteral("job"));
            m_rows->insertWidget(0, row); // newest on top
        } else {
            row->show(record);
        }
    }
    m_empty->setVisible(jobs.empty());
    m_clear->setEnabled(std::ranges::any_of(jobs, &JobRecord::ended));
    if (m_jobs.runningCount() > 0)
        m_timer.start();
    else
        m_timer.stop();
}

void JobsPanel::poll() {
    if (!isVisible())
        return;
    for (const JobRecord& record : m_jobs.jobs())
        if (const auto found = m_shown.find(record.id); found != m_shown.end())
            found->second->show(record);
}

} // namespace patina::editor

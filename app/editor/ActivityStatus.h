// What the status bar says is going on: files that are read and written, shadows that are traced,
// or else the oldest job that runs, with how far it has come, whether its dock is open or not.
#pragma once

#include <QObject>
#include <QTimer>

namespace patina::editor {

class BusyIndicator;
struct Session;

class ActivityStatus : public QObject {
    Q_OBJECT
  public:
    ActivityStatus(Session& session, BusyIndicator& indicator, QObject* parent = nullptr);

  Q_SIGNALS:
    void jobsWanted(); // a click on a job: show them all

  private:
    void refresh();

    Session& m_session;
    BusyIndicator& m_indicator;
    bool m_showsJob = false;
    QTimer m_progress; // of the job that is shown
};

} // namespace patina::editor

// Keeps the traced shadows of local lights in step with the document, where a picture is lit by a
// bake of radiance transfer: rays are traced in the background, the newest request first. Until
// they are done the shadows before stay in the picture, or what the bake's bands know.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <cstdint>
#include <optional>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;

class NearShadowUpdater : public QObject {
    Q_OBJECT
  public:
    explicit NearShadowUpdater(DocumentController& controller, QObject* parent = nullptr);

    // Whether somebody looks at local lights by way of a bake: else nothing is traced.
    void setWanted(bool wanted);
    [[nodiscard]] bool isWanted() const { return m_wanted; }
    // What is to be shown; null: nothing.
    [[nodiscard]] const NearShadowsPtr& shown() const { return m_shown; }
    // Those of the document are shown, or there are none, or none can be had.
    [[nodiscard]] bool upToDate() const;
    // What the status bar says; empty unless it takes a while.
    [[nodiscard]] QString activity() const;
    // Memory that they may take, in bytes, instead of what is free (tests).
    void setMaxBytes(std::uint64_t bytes) { m_maxBytes = bytes; }

  Q_SIGNALS:
    void shownChanged();
    void activityChanged();

  private:
    void follow(const Change& change);
    void forget();
    void update();
    void trace();
    void refuse(const NearShadowRequest& request, const Error& error);
    void show(NearShadowsPtr shadows);
    [[nodiscard]] bool refused() const; // those that m_wantedNow is

    DocumentController& m_controller;
    QTimer m_pause;    // of edits to geometry, before its hierarchy is built anew
    QTimer m_patience; // until the status bar says what goes on
    bool m_wanted = false, m_outdated = true; // of the request below
    std::uint64_t m_maxBytes = 0;
    NearShadowRequest m_request;                // what the document asks for
    std::optional<NearShadowRequest> m_traced;  // what runs
    std::optional<NearShadowRequest> m_refused; // what could not be had
    NearShadowsPtr m_shown;
    std::shared_ptr<NearShadowsPtr> m_memory; // of the job: what it traced last
    TaskGroup m_tasks;                        // last: it ends first
};

} // namespace patina::editor

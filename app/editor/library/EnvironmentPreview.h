// An environment that is looked at before anything is done with it: read and prepared in the
// background, shown by the viewport in place of the one that lights the scene, and gone without a
// trace. The document is never changed.
#pragma once

#include "app/editor/viewport/PreparedLights.h"
#include "core/job/TaskRunner.h"
#include "core/light/Environment.h"

#include <QObject>
#include <QString>

namespace patina::editor {

class DocumentController;

class EnvironmentPreview : public QObject {
    Q_OBJECT
  public:
    // Lights in full go to `lights`, which keeps to its budget. Any edit ends a preview.
    EnvironmentPreview(DocumentController& controller, PreparedLights& lights,
                       QObject* parent = nullptr);

    // By default, and as the settings say.
    [[nodiscard]] bool isWanted() const { return m_wanted; }
    void setWanted(bool wanted);

    // A file or "builtin:NAME"; the newest wins. changed() follows when its light is there, small
    // at first, and again when all of it is. Does nothing while previews are not wanted.
    void show(const QString& source, const QString& title);
    void end();

    [[nodiscard]] bool isOn() const { return m_texels != nullptr; } // there is something to show
    [[nodiscard]] const QString& title() const { return m_title; }
    [[nodiscard]] const QString& problem() const { return m_problem; } // why there is nothing
    [[nodiscard]] const EnvironmentTexelsPtr& texels() const { return m_texels; }
    // `lit`, which lights the scene, with what is previewed in place of what it shows.
    [[nodiscard]] Environment inPlaceOf(const Environment& lit) const;

  Q_SIGNALS:
    void changed();

  private:
    void prepared(const Result<IblLight>& light);
    void refine(const IblLight& small);

    DocumentController& m_controller;
    PreparedLights& m_lights;
    bool m_wanted;
    QString m_source, m_title, m_problem; // no source: none is asked for
    EnvironmentTexelsPtr m_texels;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor

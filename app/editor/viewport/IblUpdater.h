// Prepares an environment in the background, as the viewport's textures take it: its light from the
// cache, or else a small version within some ten milliseconds and the full one when it is ready.
// The newest environment wins.
#pragma once

#include "app/editor/viewport/PreparedLights.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <utility>

namespace patina::editor {

class IblUpdater : public QObject {
    Q_OBJECT
  public:
    // Its end waits for what is being written to disk.
    IblUpdater(TaskRunner& runner, PreparedLights& prepared, QObject* parent = nullptr);

    [[nodiscard]] PreparedLights& prepared() { return m_prepared; }
    void setGate(std::shared_ptr<const WorkGate> gate) { m_gate = std::move(gate); }

    // Does nothing when `environment` is the one already prepared or under way. What memory holds
    // is ready() before this returns. Requests that
    // follow each other quickly wait for the small version of the first, so that light keeps
    // coming while something is dragged.
    void request(ImagePtr environment);
    // The last result, once: it is large. Null when there is none, or it has been taken.
    [[nodiscard]] EnvironmentTexelsPtr take() { return std::exchange(m_texels, nullptr); }
    // What it was made of, for whoever else shows it, and keeps it meanwhile: large, too, and null
    // when nobody does.
    [[nodiscard]] std::shared_ptr<const IblMaps> maps() const { return m_maps.lock(); }
    // Has them made again, or found in the cache; mapsReady() follows.
    void requestMaps();
    // The light is that of the environment asked for last, at full resolution: nothing else is to
    // come.
    [[nodiscard]] bool finished() const { return m_finished; }
    // What has been taken is lost and needed again, by a new OpenGL context.
    void renew();

  Q_SIGNALS:
    void ready();     // take() has something
    void mapsReady(); // maps() has something, until the end of the call unless it is kept

  private:
    void prepare();
    void refine(const IblLight& small);
    void deliver(const IblLight& light);
    void fail(const Error& error);

    PreparedLights& m_prepared;
    std::shared_ptr<const WorkGate> m_gate; // where the light in full waits for frames
    ImagePtr m_environment;
    bool m_finished = false;
    EnvironmentTexelsPtr m_texels; // until it is taken
    std::weak_ptr<const IblMaps> m_maps;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor

// Light of the environments that cells of a wall have and the scene does not: their pictures, where
// those are generated or mixed, and what is prepared from them. Made one after another in the
// background, found in the cache where it was computed before, kept as long as the wall asks for
// it.
#pragma once

#include "app/editor/viewport/PreparedLights.h"
#include "core/document/Document.h"
#include "core/job/TaskRunner.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"

#include <QObject>
#include <vector>

namespace patina::editor {

class WallLights : public QObject {
    Q_OBJECT
  public:
    WallLights(TaskRunner& runner, PreparedLights& lights, QObject* parent = nullptr);

    // Gives a cell's document the pictures of environments that its own values ask for
    // (resolveCell() of core/cells). False while some are being made; changed() follows.
    [[nodiscard]] bool resolve(Document& shown, const Document& document);
    // Of a picture: small at first, and null before; changed() follows both times.
    [[nodiscard]] EnvironmentTexelsPtr light(const ImagePtr& picture);
    // Lets go what has not been asked for since the last call.
    void sweep();
    void clear();
    [[nodiscard]] bool busy() const { return m_tasks.busy(); }
    // Where light in full waits for frames.
    void setGate(std::shared_ptr<const WorkGate> gate) { m_gate = std::move(gate); }

  Q_SIGNALS:
    void changed(); // more is there

  private:
    struct Generated {
        EnvironmentRecipe recipe;
        ImagePtr picture; // null: to be made
        bool wanted = true;
    };
    struct Blended {
        EnvironmentBlend blend;
        ImagePtr picture;
        bool wanted = true;
    };
    struct Prepared {
        ImagePtr picture;
        IblLight light; // no texels: to be made
        bool failed = false, wanted = true;
    };
    void startNext(); // of what is to be made, unless something is under way
    bool generateNext();
    bool blendNext();
    bool prepareNext();
    bool refineNext();
    void ended();

    PreparedLights& m_lights;
    std::shared_ptr<const WorkGate> m_gate;
    std::vector<Generated> m_generated;
    std::vector<Blended> m_blended;
    std::vector<Prepared> m_prepared;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor

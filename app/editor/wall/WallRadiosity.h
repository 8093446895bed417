// Radiosity of the cells of a wall that are not the scene as it is: solved one after another in the
// background, from what the scene's own solution and those of other cells have in common with it.
// Kept as long as the wall asks for it.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/radiosity/document/LiveRadiosity.h"

#include <QObject>
#include <QString>
#include <vector>

namespace patina::editor {

class RadiosityUpdater;

class WallRadiosity : public QObject {
    Q_OBJECT
  public:
    explicit WallRadiosity(TaskRunner& runner, QObject* parent = nullptr);

    void setRadiosity(RadiosityUpdater& radiosity); // the scene's own
    struct Found {
        bool isScenes = false; // the scene's own solution, which may be on its way
        ShownRadiosityPtr shown;
        QString failure; // why there will be none; or empty
        // Neither: it is being solved; changed() follows.
        [[nodiscard]] bool waits() const { return !isScenes && !shown && failure.isEmpty(); }
    };
    // Of a cell's document, with the pictures of its environments.
    [[nodiscard]] Found find(const Document& shown, const Document& document);
    // Lets go what has not been asked for since the last call.
    void sweep();
    void clear();
    [[nodiscard]] bool busy() const { return m_tasks.busy(); }

  Q_SIGNALS:
    void changed(); // more is there

  private:
    struct Solving {
        TraceInputs inputs;
        RadiositySettings settings;
        LiveRadiosityPtr live; // null: to be solved, or it failed
        ShownRadiosityPtr shown;
        QString failure;
        bool wanted = true, running = false;
        [[nodiscard]] bool isOf(const TraceInputs& i, const RadiositySettings& s) const {
            return inputs == i && settings == s;
        }
    };
    void startNext(); // of what is to be solved, unless something is under way
    [[nodiscard]] Solving* find(const TraceInputs& inputs, const RadiositySettings& settings);
    // Of the same elements as far as there is one: the scene's, or another cell's.
    [[nodiscard]] LiveRadiosityPtr closestTo(const Solving& solving) const;

    RadiosityUpdater* m_radiosity = nullptr;
    std::vector<Solving> m_solving;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor

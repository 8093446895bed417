// What the editor's memory is used for, and the budget of what it only keeps for later: undo steps,
// bakes of other states of the scene, prepared light. What the scene needs is never at stake.
#pragma once

#include <QList>
#include <QObject>
#include <QString>
#include <QTimer>
#include <cstddef>
#include <functional>

namespace patina::editor {

struct Session;

struct MemoryPart {
    QString name, help;
    std::size_t bytes = 0;
    bool kept = false; // for later: it counts towards the budget
};

class MemoryUse : public QObject {
    Q_OBJECT
  public:
    explicit MemoryUse(Session& session, QObject* parent = nullptr);

    // Of the process, the largest first, and last what is left of residentMemory(): the program,
    // the driver with its shaders, and work in progress.
    [[nodiscard]] QList<MemoryPart> parts() const;
    [[nodiscard]] std::size_t kept() const; // bytes of all that is kept for later

    // Bytes that may be kept for later; remembered over sessions. By default a quarter of the
    // machine's memory, at most 1 GiB.
    [[nodiscard]] std::size_t budget() const { return m_budget; }
    void setBudget(std::size_t bytes);
    static constexpr std::size_t kLeastBudget = std::size_t{64} << 20;
    [[nodiscard]] static std::size_t usualBudget();

    // Keeps to the budget now; it does so by itself every second.
    void keepToBudget();
    // Gives up everything that is kept for later but the undo steps.
    void freeNow();

  private:
    // Kept for later, in the order in which it is given up: what is made again soonest goes first.
    struct Keeper {
        QString name, help;
        std::function<std::size_t()> bytes;
        std::function<void(std::size_t most)> free;
    };

    Session& m_session;
    QList<Keeper> m_keepers;
    std::size_t m_budget;
    QTimer m_timer;
};

} // namespace patina::editor

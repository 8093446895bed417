// recovery-victim PROJECT SEED: the editor's window with recovery, which opens the project and
// edits it by itself until somebody ends it. After each edit it prints its number and the time in
// milliseconds of the machine's steady clock: "edit 12 8123456".

#include "app/editor/MainWindow.h"
#include "app/editor/Recovery.h"
#include "app/editor/Session.h"
#include "app/editor/Startup.h"
#include "app/editor/TerminationWatch.h"
#include "app/editor/style/Style.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QApplication>
#include <QTimer>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <random>
#include <unistd.h>

namespace {

using namespace patina;
using namespace patina::editor;

void say(const std::string& line) {
    static_cast<void>(::write(STDOUT_FILENO, line.data(), line.size()) >= 0);
}

class Hands : public QObject {
  public:
    Hands(DocumentController& controller, unsigned seed)
        : m_controller(controller)
        , m_random(seed) {
        m_timer.setSingleShot(true);
        connect(&m_timer, &QTimer::timeout, this, &Hands::edit);
    }
    void start() { m_timer.start(0); }

  private:
    // Steps of all kinds: renamed materials, values that a drag merges into one step, lights that
    // come and go, undo. Each holds its number: in a name, or in the intensity of the first light.
    void edit() {
        const int number = ++m_number;
        const Document& document = m_controller.document();
        const Target light{Scope::Light, document.lights.front().id};
        switch (m_random() % 5) {
        case 0:
            m_controller.rename({Scope::Material, document.materials.front().id},
                                QStringLiteral("edit %1").arg(number));
            break;
        case 1:
            if (document.lights.size() < 8)
                m_controller.addLight(LightType::Point);
            else
                m_controller.removeLight(document.lights.back().id);
            drag(light, number);
            break;
        case 2:
            m_controller.setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0},
                                      static_cast<float>(number % 300));
            m_controller.undoStack().undo();
            drag(light, number);
            break;
        default:
            drag(light, number);
            break;
        }
        say(fmt::format("edit {} {}\n", number,
                        std::chrono::duration_cast<std::chrono::milliseconds>(
                            std::chrono::steady_clock::now().time_since_epoch())
                            .count()));
        m_timer.start(static_cast<int>(m_random() % 120));
    }
    void drag(Target light, int number) {
        if (m_session == 0 || m_random() % 8 == 0)
            m_session = m_controller.newDragSession();
        m_controller.setParameter(parameter("light.intensity"), light, static_cast<float>(number),
                                  m_session);
    }

    DocumentController& m_controller;
    std::mt19937 m_random;
    QTimer m_timer;
    int m_number = 0;
    DragSession m_session = 0;
};

} // namespace

int main(int argc, char* argv[]) {
    TerminationWatch watch;
    if (argc != 3)
        return 64;
    prepareApplication();
    QApplication application(argc, argv);
    applyStyle(application);
    Session session;
    int status = 0;
    {
        MainWindow window(session);
        Recovery recovery(session, window, recoveryFolder(), watch);
        Hands hands(session.controller, static_cast<unsigned>(std::atoi(argv[2])));
        QObject::connect(&session.controller, &DocumentController::sceneOpened, &hands,
                         [&] { hands.start(); });
        session.controller.openScene(QString::fromLocal8Bit(argv[1]));
        window.resize(900, 700);
        window.show();
        status = QApplication::exec();
    }
    return status;
}

#include "app/editor/HelpDialogs.h"

#include "app/editor/style/Tokens.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QIcon>
#include <QLabel>
#include <QScreen>
#include <QScrollArea>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

QString trHelp(const char* text) {
    return QCoreApplication::translate("HelpDialogs", text);
}

QLabel* keyLabel(const QString& keys) {
    auto* label = new QLabel(keys);
    label->setObjectName(QStringLiteral("key"));
    return label;
}

using Lines = QList<QPair<QString, QString>>; // keys, what they do

QWidget* page(const QString& title, const Lines& lines) {
    auto* widget = new QWidget;
    auto* grid = new QGridLayout(widget);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(2 * tokens::kMargin);
    grid->setVerticalSpacing(6);
    auto* heading = new QLabel(title);
    heading->setObjectName(QStringLiteral("heading"));
    grid->addWidget(heading, 0, 0, 1, 2);
    int row = 1;
    for (const auto& [keys, text] : lines) {
        grid->addWidget(keyLabel(keys), row, 0, Qt::AlignLeft);
        grid->addWidget(new QLabel(text), row, 1);
        ++row;
    }
    grid->setRowStretch(row, 1);
    grid->setColumnStretch(1, 1);
    return widget;
}

// What has a shortcut, with the first one.
Lines linesOf(const QList<QAction*>& actions) {
    Lines lines;
    for (const QAction* action : actions)
        if (!action->shortcut().isEmpty())
            lines << qMakePair(action->shortcut().toString(QKeySequence::NativeText),
                               action->iconText());
    return lines;
}

QDialogButtonBox* closeButton(QDialog* dialog) {
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    return buttons;
}

} // namespace

QDialog* makeShortcutsDialog(const QList<QAction*>& commands, const QList<QAction*>& views,
                             QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(trHelp("Keyboard and Mouse"));

    const Lines looking = {
        {trHelp("Shift + number"), trHelp("Backwards through the group")},
        {trHelp("Hold a key"), trHelp("Look only while it is held")},
        {trHelp("Drag the split"),
         trHelp("Move it; its ring turns it (Shift: in steps); Esc removes it")},
        {trHelp("Double-click a thumbnail"), trHelp("Show it on the other side of the split")},
    };
    const Lines viewport = {
        {trHelp("Left drag"), trHelp("Orbit")},
        {trHelp("Middle drag"), trHelp("Pan (also Shift + left drag)")},
        {trHelp("Wheel"), trHelp("Zoom")},
        {trHelp("Click"), trHelp("Select a mesh and its material, or a light")},
        {trHelp("Ctrl + Shift + click"),
         trHelp("Pin a point of the surface for the Pixel dock (also P, Alt + click)")},
        {trHelp("Right drag"), trHelp("Look around")},
        {trHelp("W A S D Q E"), trHelp("Fly while the right button is held")},
        {trHelp("Shift + right drag"), trHelp("Turn the environment")},
        {trHelp("Ctrl + right drag"),
         trHelp("Turn the selected light about the scene, or the environment")},
        {trHelp("Drag a light's mark"), trHelp("Move it; a sun turns")},
        {trHelp("Drag its handles"),
         trHelp("Move it along X, Y, Z, or aim it; Esc takes the drag back")},
        {trHelp("Drag a mesh's handles"),
         trHelp("Move, rotate or scale it (Shift+M shows them); Ctrl snaps")},
    };
    const Lines fields = {
        {trHelp("Drag a number"), trHelp("Change it; Shift is fine, Ctrl is coarse")},
        {trHelp("Click a number"), trHelp("Type it; Enter takes it, Esc does not")},
        {trHelp("Wheel, ↑, ↓"), trHelp("Step the focused number")},
        {trHelp("Double-click a label"), trHelp("Reset to the default")},
        {trHelp("Rest on an environment"), trHelp("Preview it, in the Environment Library")},
        {trHelp("Shift + drag its picture"), trHelp("Turn the environment that lights the scene")},
    };
    auto* right = new QVBoxLayout;
    right->setSpacing(2 * tokens::kMargin);
    right->addWidget(page(trHelp("Viewport"), viewport));
    right->addWidget(page(trHelp("Looking at views"), looking));
    right->addWidget(page(trHelp("Panels"), fields));
    right->addStretch(1);
    auto* pages = new QWidget;
    auto* columns = new QHBoxLayout(pages);
    columns->setContentsMargins(0, 0, 0, 0);
    columns->setSpacing(4 * tokens::kMargin);
    columns->addWidget(page(trHelp("Commands"), linesOf(commands)), 0, Qt::AlignTop);
    columns->addWidget(page(trHelp("Views"), linesOf(views)), 0, Qt::AlignTop);
    columns->addLayout(right);
    // Where a scaled screen is too small for them, they are scrolled.
    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidgetResizable(true);
    pages->setObjectName(QStringLiteral("helpPages"));
    scroll->setWidget(pages);
    auto* layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(2 * tokens::kMargin, 2 * tokens::kMargin, 2 * tokens::kMargin,
                               tokens::kMargin);
    layout->setSpacing(2 * tokens::kMargin);
    layout->addWidget(scroll);
    layout->addWidget(closeButton(dialog));
    // With air for what the style sheet adds to labels and buttons when they are shown.
    const QMargins margins = layout->contentsMargins();
    const int air = 2 * tokens::kMargin;
    const QSize wanted =
        pages->sizeHint() + QSize(margins.left() + margins.right() + air,
                                  dialog->sizeHint().height() - scroll->sizeHint().height() + air);
    // No higher than the window that it explains: that fits the screen, frame included.
    dialog->resize(wanted.boundedTo(0.95 * parent->screen()->availableSize())
                       .boundedTo(QSize(QWIDGETSIZE_MAX, parent->window()->height())));
    return dialog;
}

QDialog* makeAboutDialog(QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(trHelp("About Patina"));
    auto* picture = new QLabel;
    picture->setPixmap(QIcon(QStringLiteral(":/icons/patina.svg"))
                           .pixmap(QSize(72, 72), dialog->devicePixelRatioF()));
    auto* text = new QLabel(
        trHelp(
            "<h2>Patina %1</h2>"
            "<p>Author physically based materials and trust what you see.</p>"
            "<p>Apache License 2.0. Built with Qt, Embree, oneTBB, Assimp, OpenImageIO, OpenEXR, "
            "GLM, libepoxy, fmt, spdlog and JSON for Modern C++.</p>")
            .arg(QCoreApplication::applicationVersion()));
    text->setWordWrap(true);
    text->setMinimumWidth(360);
    auto* row = new QHBoxLayout;
    row->setSpacing(2 * tokens::kMargin);
    row->addWidget(picture, 0, Qt::AlignTop);
    row->addWidget(text, 1);
    auto* layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(2 * tokens::kMargin, 2 * tokens::kMargin, 2 * tokens::kMargin,
                               tokens::kMargin);
    layout->addLayout(row);
    layout->addWidget(closeButton(dialog));
    return dialog;
}

} // namespace patina::editor

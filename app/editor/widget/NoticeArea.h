// Notices over the lower edge of the picture: they tell what happened without stopping anything or
// moving the picture. The newest two are shown, one where two would cover too much of the picture;
// the log keeps all. A warning that was dismissed does not come again in this session.
#pragma once

#include "app/editor/document/UserNotice.h"

#include <QFrame>
#include <QPixmap>
#include <QPointer>
#include <QSet>
#include <QTimer>
#include <QWidget>

class QLabel;
class QToolButton;
class QVariantAnimation;
class QVBoxLayout;

namespace patina::editor {

class NoticeBar : public QFrame {
    Q_OBJECT
  public:
    // `name`: what the notice calls its file, which may be with its folder.
    NoticeBar(const UserNotice& notice, const QString& name, QWidget* parent = nullptr);
    [[nodiscard]] const UserNotice& notice() const { return m_notice; }
    [[nodiscard]] QString text() const; // as shown
    void setFileName(const QString& name);
    void countOnceMore(); // the same notice came again

  Q_SIGNALS:
    void dismissed(); // by the user
    void faded();     // by itself

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void refreshText();
    void fade(); // unless somebody is reading it
    void stopFading();

    UserNotice m_notice;
    QString m_fileName;
    int m_count = 1;
    QLabel* m_text;
    QToolButton* m_more = nullptr; // unfolds the details
    QTimer m_life;                 // of good news, which go by themselves
    QVariantAnimation* m_fade = nullptr;
    QPixmap m_fading; // as it was when that began
};

class NoticeArea : public QWidget {
    Q_OBJECT
  public:
    explicit NoticeArea(QWidget& picture); // a child of it
    void add(const UserNotice& notice);
    // Notices stand above it where it is in their way: another child of the picture at its lower
    // edge.
    void keepClearOf(QWidget& below);
    // Another scene is open: its own notices come after this. Those of the one before go; the start
    // scene leaves what was said about files that could not be opened.
    void sceneReplaced(bool byStartScene);
    // The picture is not what the viewport draws: notices about that wait until it is again.
    void setTraced(bool traced);
    [[nodiscard]] QList<NoticeBar*> bars() const { return m_bars; } // newest first

  protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    [[nodiscard]] QString nameOf(const QString& file) const;
    void remove(NoticeBar* bar);
    [[nodiscard]] bool waits(const NoticeBar& bar) const;
    void showBars();
    void place();

    bool m_traced = false;
    QWidget& m_picture;
    QPointer<QWidget> m_below; // null: none
    QVBoxLayout* m_layout;
    QList<NoticeBar*> m_bars;
    QSet<QString> m_files;     // that notices of this session have named
    QSet<QString> m_dismissed; // warnings: file and text
};

} // namespace patina::editor

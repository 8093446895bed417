#include "app/editor/memory/MemoryDialog.h"

#include "app/editor/memory/MemoryUse.h"
#include "app/editor/style/Tokens.h"
#include "core/bake/BakeMemory.h"
#include "core/base/ProcessMemory.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTimer>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr int kRefreshMs = 1000;
constexpr int kSteps = 1000; // of a bar
constexpr int kMiB = 20;     // as a power of two

QString trMemory(const char* text) {
    return QCoreApplication::translate("MemoryDialog", text);
}

QString sizeText(std::size_t bytes) {
    return bytes == 0 ? trMemory("none") : QString::fromStdString(memoryText(bytes));
}

class MemoryDialog : public QDialog {
  public:
    MemoryDialog(MemoryUse& memory, QWidget* parent)
        : QDialog(parent)
        , m_memory(memory)
        , m_rows(new QGridLayout)
        , m_total(new QLabel)
        , m_kept(new QLabel)
        , m_budget(new QSpinBox) {
        setAttribute(Qt::WA_DeleteOnClose);
        setWindowTitle(trMemory("Memory"));
        m_rows->setHorizontalSpacing(2 * tokens::kMargin);
        m_rows->setVerticalSpacing(tokens::kGap);
        m_rows->setColumnStretch(1, 1);
        m_total->setObjectName(QStringLiteral("heading"));
        m_kept->setWordWrap(true);

        m_budget->setObjectName(QStringLiteral("memoryBudget"));
        m_budget->setRange(static_cast<int>(MemoryUse::kLeastBudget >> kMiB), 1 << 20);
        m_budget->setSingleStep(64);
        m_budget->setSuffix(trMemory(" MiB"));
        m_budget->setValue(static_cast<int>(memory.budget() >> kMiB));
        const QString budgetTip =
            trMemory("Undo steps, earlier bakes and prepared light together; "
                     "what is oldest goes first. Never what the scene needs.");
        m_budget->setToolTip(budgetTip);
        m_budget->setAccessibleName(trMemory("Most that is kept for later"));
        m_budget->setAccessibleDescription(budgetTip);
        auto* label = new QLabel(trMemory("Keep for &later at most"));
        label->setBuddy(m_budget);
        label->setToolTip(budgetTip);
        auto* free = new QPushButton(trMemory("&Free Now"));
        free->setAutoDefault(false); // Enter takes the number
        free->setObjectName(QStringLiteral("memoryFree"));
        free->setToolTip(trMemory("Give up prepared light and earlier bakes; undo steps stay"));
        auto* row = new QHBoxLayout;
        row->addWidget(label);
        row->addWidget(m_budget);
        row->addStretch(1);
        row->addWidget(free);

        auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
        auto* layout = new QVBoxLayout(this);
        layout->setContentsMargins(2 * tokens::kMargin, 2 * tokens::kMargin, 2 * tokens::kMargin,
                                   tokens::kMargin);
        layout->setSpacing(tokens::kMargin);
        layout->addWidget(m_total);
        layout->addLayout(m_rows);
        layout->addWidget(m_kept);
        layout->addLayout(row);
        layout->addStretch(1);
        layout->addWidget(buttons);
        connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
        connect(free, &QPushButton::clicked, this, [this] {
            m_memory.freeNow();
            refresh();
        });
        connect(m_budget, &QSpinBox::editingFinished, this, [this] {
            m_memory.setBudget(static_cast<std::size_t>(m_budget->value()) << kMiB);
            refresh();
        });
        m_timer.setInterval(kRefreshMs);
        connect(&m_timer, &QTimer::timeout, this, [this] { refresh(); });
        m_timer.start();
        setMinimumWidth(460);
        refresh();
    }

  private:
    struct Row {
        QLabel *name, *size;
        QProgressBar* bar;
    };

    void refresh() {
        const QList<MemoryPart> parts = m_memory.parts();
        const std::size_t all = std::max<std::size_t>(residentMemory(), 1);
        while (m_shown.size() < parts.size()) {
            Row row{new QLabel, new QLabel, new QProgressBar};
            row.size->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
            row.bar->setRange(0, kSteps);
            row.bar->setTextVisible(false);
            row.bar->setFixedHeight(6);
            const int at = static_cast<int>(m_shown.size());
            m_rows->addWidget(row.name, at, 0);
            m_rows->addWidget(row.bar, at, 1);
            m_rows->addWidget(row.size, at, 2);
            m_shown.append(row);
        }
        for (qsizetype i = 0; i < parts.size(); ++i) {
            const MemoryPart& part = parts[i];
            const Row& row = m_shown[i];
            row.name->setText(part.name);
            row.size->setText(sizeText(part.bytes));
            row.bar->setValue(static_cast<int>(kSteps * std::min(part.bytes, all) / all));
            row.bar->setAccessibleName(part.name);
            const QString tip =
                part.kept ? trMemory("%1. Kept for later.").arg(part.help) : part.help;
            for (QWidget* widget :
                 {static_cast<QWidget*>(row.name), static_cast<QWidget*>(row.size),
                  static_cast<QWidget*>(row.bar)})
                widget->setToolTip(tip);
        }
        m_total->setText(trMemory("Patina uses %1 of %2")
                             .arg(sizeText(residentMemory()), sizeText(installedMemory())));
        m_kept->setText(trMemory("Kept for later: %1 of %2")
                            .arg(sizeText(m_memory.kept()), sizeText(m_memory.budget())));
    }

    MemoryUse& m_memory;
    QGridLayout* m_rows;
    QLabel *m_total, *m_kept;
    QSpinBox* m_budget;
    QList<Row> m_shown;
    QTimer m_timer;
};

} // namespace

QDialog* makeMemoryDialog(MemoryUse& memory, QWidget* parent) {
    return new MemoryDialog(memory, parent);
}

} // namespace patina::editor

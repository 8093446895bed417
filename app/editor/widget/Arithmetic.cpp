#include "app/editor/widget/Arithmetic.h"

#include <QLocale>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kMaxDepth = 64; // of parentheses and powers

// Recursive descent: sum → product → signed → power → atom. What cannot be read leaves m_ok false.
class Reader {
  public:
    explicit Reader(QString text)
        : m_text(std::move(text)) {}

    std::optional<double> read() {
        const double value = sum();
        skipSpace();
        if (!m_ok || m_at < m_text.size() || !std::isfinite(value))
            return std::nullopt;
        return value;
    }

  private:
    void skipSpace() {
        while (m_at < m_text.size() && m_text[m_at].isSpace())
            ++m_at;
    }
    bool accept(char sign) {
        skipSpace();
        if (m_at >= m_text.size() || m_text[m_at] != QLatin1Char(sign))
            return false;
        ++m_at;
        return true;
    }
    double fail() {
        m_ok = false;
        return 0.0;
    }

    double sum() {
        double value = product();
        while (m_ok) {
            if (accept('+'))
                value += product();
            else if (accept('-'))
                value -= product();
            else
                break;
        }
        return value;
    }
    double product() {
        double value = signedValue();
        while (m_ok) {
            if (accept('*'))
                value *= signedValue();
            else if (accept('/'))
                value /= signedValue();
            else
                break;
        }
        return value;
    }
    // One sign at most ("--1" is a slip). It binds weaker than a power: -2^2 is -4.
    double signedValue() {
        if (++m_depth > kMaxDepth)
            return fail();
        double value = 0.0;
        if (accept('-'))
            value = -power();
        else if (accept('+'))
            value = power();
        else
            value = power();
        --m_depth;
        return value;
    }
    double power() {
        const double base = atom();
        return m_ok && accept('^') ? std::pow(base, signedValue()) : base;
    }
    double atom() {
        if (accept('(')) {
            const double value = sum();
            return accept(')') ? value : fail();
        }
        return number();
    }
    double number() {
        skipSpace();
        const qsizetype from = m_at;
        const auto digits = [this] {
            while (m_at < m_text.size() && m_text[m_at].isDigit())
                ++m_at;
        };
        digits();
        if (m_at < m_text.size() && m_text[m_at] == QLatin1Char('.'))
            ++m_at;
        digits();
        // "1e3": an exponent only where digits follow.
        if (m_at > from && m_at < m_text.size() && m_text[m_at].toLower() == QLatin1Char('e')) {
            const qsizetype before = m_at++;
            if (m_at < m_text.size() && QStringLiteral("+-").contains(m_text[m_at]))
                ++m_at;
            const qsizetype exponent = m_at;
            digits();
            if (m_at == exponent)
                m_at = before;
        }
        bool ok = false;
        const double value = QLocale::c().toDouble(m_text.mid(from, m_at - from), &ok);
        return ok ? value : fail();
    }

    QString m_text;
    qsizetype m_at = 0;
    int m_depth = 0;
    bool m_ok = true;
};

} // namespace

std::optional<double> evaluate(const QString& text) {
    QString plain = text;
    plain.replace(QLatin1Char(','), QLatin1Char('.'));
    plain.replace(QChar(0x2212), QLatin1Char('-')); // minus sign
    plain.replace(QChar(0x00d7), QLatin1Char('*')); // multiplication sign
    plain.replace(QChar(0x00b7), QLatin1Char('*')); // middle dot
    plain.replace(QChar(0x00f7), QLatin1Char('/')); // division sign
    return Reader(std::move(plain)).read();
}

} // namespace patina::editor

//! Simple arithmetic: text to a tree, and its value.
//!
//! ```text
//! sum = product (('+' | '-') product)*        product = sign (('*' | '/' | '%') sign)*       sign = ('+' | '-') sign | power
//! power = atom ('^' sign)?                    atom = number | name | function '(' sum (',' sum)* ')' | '(' sum ')'
//! ```
//! The crates at hand either are under the AGPL or misread nested calls.

/// Longer texts are no arithmetic that somebody wrote; it bounds the depth of the tree as well.
const LONGEST: usize = 400;

type Function1 = fn(f64) -> f64;
type Function2 = fn(f64, f64) -> f64;

/// A tree of arithmetic.
#[derive(Clone, Debug)]
pub(crate) enum Arithmetic {
    Number(f64),
    Name(String),
    Unary(Function1, Box<Arithmetic>),
    Binary(Function2, Box<Arithmetic>, Box<Arithmetic>),
}

/// Functions of one number.
const UNARY: [(&str, Function1); 11] = [
    ("sqrt", f64::sqrt),
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("abs", f64::abs),
    ("floor", f64::floor),
];

/// Functions of two numbers.
const BINARY: [(&str, Function2); 3] = [("atan2", f64::atan2), ("min", f64::min), ("max", f64::max)];

impl Arithmetic {
    /// Reads a text; an error says what was expected instead of what.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST {
            return Err(format!("it is longer than {LONGEST} characters"));
        }
        let mut parser = Parser { text, at: 0 };
        let sum = parser.sum()?;
        match parser.peek() {
            None => Ok(sum),
            Some(other) => Err(format!("`{other}` is not expected after `{}`", text[..parser.at].trim())),
        }
    }

    /// Its value; `variable` gives those of names.
    pub(crate) fn value<E>(&self, variable: &impl Fn(&str) -> Result<f64, E>) -> Result<f64, E> {
        Ok(match self {
            Self::Number(value) => *value,
            Self::Name(name) => variable(name)?,
            Self::Unary(function, a) => function(a.value(variable)?),
            Self::Binary(function, a, b) => function(a.value(variable)?, b.value(variable)?),
        })
    }

    /// Calls `see` with each name that it uses.
    pub(crate) fn each_name<'a>(&'a self, see: &mut impl FnMut(&'a str)) {
        match self {
            Self::Number(_) => {}
            Self::Name(name) => see(name),
            Self::Unary(_, a) => a.each_name(see),
            Self::Binary(_, a, b) => {
                a.each_name(see);
                b.each_name(see);
            }
        }
    }
}

/// Whether a name means something by itself.
pub(crate) fn is_function(name: &str) -> bool {
    UNARY.iter().any(|(known, _)| *known == name) || BINARY.iter().any(|(known, _)| *known == name)
}

/// Whether a text is a name.
pub(crate) fn is_name(text: &str) -> bool {
    text.chars().next().is_some_and(begins_name) && text.chars().all(continues_name)
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
}

impl Parser<'_> {
    fn peek(&mut self) -> Option<char> {
        let rest = self.text[self.at..].trim_start();
        self.at = self.text.len() - rest.len();
        rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    /// Operands joined by operators of one rank, from left to right.
    fn chain(
        &mut self,
        operand: fn(&mut Self) -> Result<Arithmetic, String>,
        operators: &[(char, Function2)],
    ) -> Result<Arithmetic, String> {
        let mut left = operand(self)?;
        while let Some(&(_, apply)) = operators.iter().find(|(symbol, _)| self.take(*symbol)) {
            left = Arithmetic::Binary(apply, Box::new(left), Box::new(operand(self)?));
        }
        Ok(left)
    }

    fn sum(&mut self) -> Result<Arithmetic, String> {
        self.chain(Self::product, &[('+', |a, b| a + b), ('-', |a, b| a - b)])
    }

    fn product(&mut self) -> Result<Arithmetic, String> {
        self.chain(Self::sign, &[('*', |a, b| a * b), ('/', |a, b| a / b), ('%', f64::rem_euclid)])
    }

    fn sign(&mut self) -> Result<Arithmetic, String> {
        if self.take('-') {
            return Ok(Arithmetic::Unary(|a| -a, Box::new(self.sign()?)));
        }
        if self.take('+') { self.sign() } else { self.power() }
    }

    fn power(&mut self) -> Result<Arithmetic, String> {
        let base = self.atom()?;
        if self.take('^') {
            return Ok(Arithmetic::Binary(f64::powf, Box::new(base), Box::new(self.sign()?)));
        }
        Ok(base)
    }

    fn atom(&mut self) -> Result<Arithmetic, String> {
        if self.take('(') {
            let inner = self.sum()?;
            return self.close().map(|()| inner);
        }
        match self.peek() {
            Some(c) if begins_name(c) => self.named(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) => Err(format!("a number or a name is expected before `{c}`")),
            None => Err("a number or a name is expected at its end".into()),
        }
    }

    fn close(&mut self) -> Result<(), String> {
        if self.take(')') { Ok(()) } else { Err("a parenthesis is not closed".into()) }
    }

    fn word(&mut self, belongs: impl Fn(char) -> bool) -> &str {
        let rest = &self.text[self.at..];
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn number(&mut self) -> Result<Arithmetic, String> {
        let start = self.at;
        self.word(|c| c.is_ascii_digit() || c == '.');
        let exponent = self.text[self.at..].strip_prefix(['e', 'E']);
        if let Some(exponent) = exponent {
            let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
            if digits.starts_with(|c: char| c.is_ascii_digit()) {
                self.at = self.text.len() - digits.len();
                self.word(|c| c.is_ascii_digit());
            }
        }
        let text = &self.text[start..self.at];
        text.parse().map(Arithmetic::Number).map_err(|_| format!("`{text}` is no number"))
    }

    fn named(&mut self) -> Result<Arithmetic, String> {
        let name = self.word(continues_name).to_string();
        if let Some((_, function)) = UNARY.iter().find(|(known, _)| *known == name) {
            let [a] = self.arguments(&name)?;
            return Ok(Arithmetic::Unary(*function, Box::new(a)));
        }
        if let Some((_, function)) = BINARY.iter().find(|(known, _)| *known == name) {
            let [a, b] = self.arguments(&name)?;
            return Ok(Arithmetic::Binary(*function, Box::new(a), Box::new(b)));
        }
        if self.peek() == Some('(') {
            let known = UNARY.iter().map(|f| f.0).chain(BINARY.iter().map(|f| f.0)).collect::<Vec<_>>();
            return Err(format!("there is no function `{name}`, but {}", known.join(", ")));
        }
        Ok(Arithmetic::Name(name))
    }

    fn arguments<const N: usize>(&mut self, function: &str) -> Result<[Arithmetic; N], String> {
        if !self.take('(') {
            return Err(format!("`{function}` is a function; write {function}(...)"));
        }
        let mut list = vec![self.sum()?];
        while self.take(',') {
            list.push(self.sum()?);
        }
        self.close()?;
        let found = list.len();
        list.try_into().map_err(|_| format!("`{function}` takes {N} numbers, not {found}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        let variable = |name: &str| match name {
            "a" => Ok(7.0),
            "b" => Ok(2.0),
            _ => Err(name.to_string()),
        };
        Arithmetic::parse(text).unwrap().value(&variable).unwrap()
    }

    #[test]
    fn arithmetic_is_that_of_school() {
        for (text, expected) in [
            ("sqrt(2)/20", 2.0_f64.sqrt() / 20.0),
            ("1/2*3", 1.5),
            ("12/3/2", 2.0),
            ("7-2-1", 4.0),
            ("7 - 2 + 1", 6.0),
            ("2*a^2", 98.0),
            ("-b^2 + 1", -3.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("(a+1)%3", 2.0),
            ("-1 % 3", 2.0),
            ("a * -b", -14.0),
            ("atan2(a, b)/2", 7.0_f64.atan2(2.0) / 2.0),
            ("max(a, min(b, 9))*2", 14.0),
            ("1e-3*b", 2e-3),
            ("1.5E2", 150.0),
            (".5", 0.5),
        ] {
            assert_eq!(value(text), expected, "{text}");
        }
    }

    #[test]
    fn nonsense_is_named() {
        for (text, part) in [
            ("", "at its end"),
            ("1 +", "at its end"),
            ("(1", "not closed"),
            ("1 2", "`2` is not expected after `1`"),
            ("foo(1)", "no function `foo`"),
            ("sin 1", "write sin(...)"),
            ("min(1)", "takes 2 numbers, not 1"),
            ("1.2.3", "`1.2.3` is no number"),
            ("1 $ 2", "`$` is not expected"),
            ("2e", "`e` is not expected"),
        ] {
            let error = Arithmetic::parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(Arithmetic::parse(&"(".repeat(399)).is_err());
        assert!(Arithmetic::parse(&"1+".repeat(300)).unwrap_err().contains("longer"));
    }
}

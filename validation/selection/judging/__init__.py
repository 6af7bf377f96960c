"""Models and rules from outside, beside what boundary elements and closed forms answer."""

"""Conditions and arithmetic as studies and kits write them: a number, a term's name, or (sign, operands ...)."""


class Conditions:
    """A reader that has `take` of signs, `next` of any token, and `signed` for what stands between the signs."""

    def expression(self):
        return self.chain(self.both, "or")

    def both(self):
        return self.chain(self.denied, "and")

    def denied(self):
        return ("not", self.denied()) if self.take("not") else self.compared()

    def compared(self):
        left = self.sum()
        if self.take("in"):
            low = self.sum()
            self.next()
            return ("in", left, low, self.sum())
        sign = self.take("=", "<", "<=", ">=", ">", "!=")
        return (sign, left, self.sum()) if sign else left

    def sum(self):
        return self.chain(self.product, "+", "-")

    def product(self):
        return self.chain(self.signed, "*", "/")

    def chain(self, operand, *signs):
        left = operand()
        while sign := self.take(*signs):
            left = (sign, left, operand())
        return left

# SPDX-License-Identifier: MIT
"""Bytes, models and entropy decoders: docs/FORMAT.md, introduction and sections 3 and 6."""
import re
import struct


class Corrupt(Exception):
    pass


def require(claim, what):
    if not claim:
        raise Corrupt(what)


class Bytes:
    """Reads integers, strings and hashes from the front."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        require(count <= len(self.data) - self.at, 'cut short')
        self.at += count
        return self.data[self.at - count:self.at]

    def unpack(self, kind):
        return struct.unpack('<' + kind, self.take(struct.calcsize('<' + kind)))[0]

    def varint(self):
        value = 0
        for shift in range(0, 64, 7):
            byte = self.take(1)[0]
            value |= (byte & 127) << shift
            if byte < 128:
                require(byte > 0 or shift == 0, 'a varint that could be shorter')
                return value
        raise Corrupt('a varint of more than 64 bits')

    def string(self):
        return self.take(self.varint()).decode()

    def at_end(self):
        return self.at == len(self.data)


class Model:
    def __init__(self, start, uses, limit):
        self.start, self.uses, self.limit = list(start), uses, limit

    def find(self, slot):
        return max(s for s in range(16) if self.start[s] <= slot)

    def share(self, symbol):
        end = self.start[symbol + 1] if symbol < 15 else 1 << 15
        return self.start[symbol], end - self.start[symbol]

    def update(self, symbol):
        shift = self.uses.bit_length()
        for i in range(16):
            target = i if i <= symbol else (1 << 15) - 16 + i
            self.start[i] += min(target - self.start[i] + (1 << (shift - 1)), 32767) >> shift
        if self.uses != self.limit:
            self.uses += 1


MANTISSA = [round(2 ** (16 - i / 12)) for i in range(12)]


def model_of_text(text):
    if not text:
        return [2048 * i for i in range(16)], 4, 127
    numbers = bytes.fromhex(text)
    weights = [MANTISSA[level % 12] * 2 ** 16 >> level // 12 for level in numbers[:16]]
    total = sum(weights)
    shares = [1 + weight * (2 ** 15 - 16) // total for weight in weights]
    shares[weights.index(max(weights))] += 2 ** 15 - sum(shares)
    return [sum(shares[:s]) for s in range(16)], numbers[16], numbers[17]


class Tables:
    """common/codec/trained_tables.inc."""

    def __init__(self, path):
        with open(path, encoding='ascii') as file:
            region, bundle, shape, size = file.read().split('constexpr')[1:]
        self.region = [model_of_text(t) for t in re.findall(r'"([0-9a-f]*)"', region)]
        self.bundle = [model_of_text(t) for t in re.findall(r'"([0-9a-f]*)"', bundle)]
        numbers = [int(n) for n in re.findall(r'-?\d+', shape.split('{', 1)[1])]
        self.shape = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        numbers = [int(n) for n in re.findall(r'-?\d+', size.split('{', 1)[1])]
        self.size = [[numbers[27 * c + 9 * a:27 * c + 9 * a + 9] for a in range(3)] for c in range(4)]


class Decoder:
    def __init__(self, bank):
        self.bank = bank
        self.models = {}

    def model(self, number):
        if number not in self.models:
            self.models[number] = Model(*self.bank[number])
        return self.models[number]

    def number(self, model):
        length = self.symbol(model)
        if length == 15:
            length += self.bits(5)
        require(length <= 32, 'a number of more than 32 bits')
        return length if length < 2 else (1 << (length - 1)) + self.bits(length - 1)

    def signed(self, model):
        folded = self.number(model)
        return -(folded + 1) // 2 if folded & 1 else folded // 2


class Rans(Decoder):
    """32-bit words from the front, plain bits from the back."""

    def __init__(self, data, bank):
        super().__init__(bank)
        self.data, self.at = data, 0
        self.bits_taken = 0
        self.state = self.take(6)
        require(self.state >= 1 << 16, 'a state too small')

    def take(self, count):
        require(self.at + count <= len(self.data), 'cut short')
        self.at += count
        return int.from_bytes(self.data[self.at - count:self.at], 'little')

    def symbol(self, number):
        model = self.model(number)
        slot = self.state & 0x7fff
        symbol = model.find(slot)
        start, share = model.share(symbol)
        self.state = share * (self.state >> 15) + slot - start
        if self.state < 1 << 16:
            self.state = self.state << 32 | self.take(4)
        model.update(symbol)
        return symbol

    def bits(self, count):
        value = 0
        for i in range(count):
            byte = len(self.data) - 1 - self.bits_taken // 8
            require(byte >= 0, 'cut short')
            value |= (self.data[byte] >> self.bits_taken % 8 & 1) << i
            self.bits_taken += 1
        return value

    def uniform(self, count):
        length = count.bit_length() - 1
        short = (1 << (length + 1)) - count
        x = self.bits(length)
        return x if x < short else 2 * x + self.bits(1) - short

    def finish(self):
        require(self.state == 1 << 16, 'a state left over')
        require(self.bits(-self.bits_taken % 8) == 0, 'bits left over')
        require(self.at == len(self.data) - self.bits_taken // 8, 'bytes left over')


class RangeCoder(Decoder):
    def __init__(self, data, bank):
        super().__init__(bank)
        self.data, self.at = data, 0
        self.range, self.above = (1 << 32) - 1, 0
        for _ in range(4):
            self.above = self.above << 8 | self.next_byte()

    def next_byte(self):
        self.at += 1
        return self.data[self.at - 1] if self.at <= len(self.data) else 0

    def share(self, count):
        self.unit = self.range // count
        share = self.above // self.unit
        require(share < count, 'outside all shares')
        return share

    def take(self, first, width):
        self.above -= first * self.unit
        self.range = width * self.unit
        while self.range < 1 << 24:
            self.range <<= 8
            self.above = self.above << 8 | self.next_byte()

    def symbol(self, number):
        model = self.model(number)
        symbol = model.find(self.share(1 << 15))
        self.take(*model.share(symbol))
        model.update(symbol)
        return symbol

    def choice(self, count):
        last, high = (count - 1) >> 16, 0
        if last > 0:
            high = self.share(last + 1)
            self.take(high, 1)
        low = self.share(1 << 16 if high < last else ((count - 1) & 0xffff) + 1)
        self.take(low, 1)
        return high << 16 | low

    def bits(self, count):
        return self.choice(1 << count)

    def finish(self):
        put_out = self.at - 4
        last_four = bytes(self.data[put_out:self.at]).ljust(4, b'\0')
        window = int.from_bytes(last_four, 'big')
        low = window - self.above
        for kept in range(0 if put_out else 1, 5):
            unit = 1 << (32 - 8 * kept)
            lowest = -(-low // unit) * unit
            if lowest < low + self.range:
                break
        require(lowest == window and len(self.data) == put_out + kept, 'not as an encoder ends')

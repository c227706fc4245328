"""What a browser would find in a page, for the tests."""
import html.parser


class References(html.parser.HTMLParser):
    """Collects what a browser would fetch, the ids, and what stands in the text."""

    def __init__(self):
        super().__init__()
        self.fetched, self.scripts, self.tables, self.ids = [], 0, [], []

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("src", "href", "xlink:href", "data", "action", "poster"):
                self.fetched.append((tag, value))
            if name == "id":
                self.ids.append(value)
                if tag == "table":
                    self.tables.append(value)
        self.scripts += tag == "script"
        assert tag not in ("link", "iframe", "object", "embed", "base")

"""The paper's two lenses as SKUs, with the values of its Table 2. Not here: what is measured on them."""

from service.demo.skus import PAPER_SKUS
from service.usecases.sku_document import Revision, SkuDocument

CODES = tuple(str(sku["code"]) for sku in PAPER_SKUS)


def paper_lens(code: str) -> Revision:
    """Return the SKU revision of `lens1` or `lens2`."""
    documents = {sku["code"]: sku for sku in PAPER_SKUS}
    return SkuDocument.model_validate(documents[code]).to_revision()

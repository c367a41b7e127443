"""Signing in on the page: the token once, then a cookie."""

import asyncio

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict, Field

from vocalis.server.exceptions import NotAuthorised
from vocalis.server.http.openapi import ok, problems
from vocalis.server.services import Shared

router = APIRouter(tags=["session"])
WRONG_TOKEN_S = 0.5  # delay of the answer to a wrong token


class SessionBody(BaseModel):
    model_config = ConfigDict(extra="forbid")
    token: str = Field(max_length=1000, description="printed by the server, or set in VOCALIS_TOKEN")


class Session(BaseModel):
    signed_in: bool


@router.post("/session", responses=ok(model=Session) | problems(415, 422))
async def open_session(body: SessionBody, request: Request, shared: Shared) -> JSONResponse:
    """Set the session cookie for the token; a server without a token sets it for everybody and never needs it."""
    access = shared.access
    if access.token is not None and not access.is_token(body.token):
        await asyncio.sleep(WRONG_TOKEN_S)
        raise NotAuthorised("That is not the token of this server.")
    response = JSONResponse({"signed_in": True})
    access.open_session(response)
    access.identify(request, response)
    return response
